// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_LABEL_SCORES_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_LABEL_SCORES_H

#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/internal/Voxel_box.h>
#include <CGAL/Mixed_mesh_image_3/internal/smooth_indicator.h>
#include <CGAL/Mixed_mesh_image_3/label_extents.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The number of a label of several, from 1 on; 0 is the outside.
using Label_number = std::uint16_t;

/// A box of voxels of an image, with 0 at its border, and the smoothed indicators of several labels. A voxel
/// has the label with the best score, its indicator times a weight, if it is inside: where the odds of the
/// outside, against all labels together, are less than this weight times one of the outside. So there is no
/// groove where two labels meet the outside, and no weight gives a label a voxel that it is not near to:
/// where numbers were added to indicators, a layer with a large one had voxels at all other interfaces.
class Label_scores : public Voxel_box
{
public:
  using Weights = std::vector<float>; // of the outside, and of label 1, 2, ...

  // Weight with which labels are kept. Of its indicator, a layer of one voxel has 0.38 if the deviation is a
  // voxel, a line 0.15, a voxel alone 0.06: layers and lines are kept, specks are not.
  static constexpr float largest_weight = 8;

private:
  static constexpr float infinity = std::numeric_limits<float>::infinity();

  std::vector<Indicator> m_indicators; // of label 1, 2, ...
  std::vector<float> m_outside;        // one minus all of them
  Weights m_weights;
  std::vector<Label_number> m_in_image;     // the label of each voxel
  std::vector<std::size_t> m_numbers;       // of voxels of each label, from 1 on
  std::vector<float> m_best, m_second_best; // scores
  std::vector<Label_number> m_labels;       // with the best scores
  std::array<std::size_t, 8> m_steps{};     // to voxels in directions: bit i says whether along axis i
  std::vector<std::uint8_t> m_is_known;     // bit d: the edge from the voxel in direction d

public:
  /// \param has_label functions `bool(float)`, one for each label
  /// \param extents boxes around the labels
  /// \param deviations deviations of the Gaussian, in voxels along each axis
  template <class HasLabel>
  Label_scores(const Voxel_image_3& image, const std::vector<HasLabel>& has_label,
               const std::vector<Label_extent_3>& extents, const std::array<double, 3>& deviations,
               unsigned threads)
    : m_indicators(has_label.size()), m_weights(has_label.size() + 1, 1.f)
  {
    parallel_for(
      has_label.size(), threads,
      [&](std::size_t l) { m_indicators[l] = smooth_indicator(image, has_label[l], deviations, extents[l]); },
      1);
    surround_indicators();
    for(std::size_t l = 0; l < has_label.size(); ++l)
      m_numbers.push_back(extents[l].number_of_voxels);
    if(!is_empty()) {
      const std::array<std::size_t, 3> s = strides();
      for(std::size_t d = 0; d < 8; ++d)
        m_steps[d] = (d & 1) * s[0] + (d >> 1 & 1) * s[1] + (d >> 2) * s[2];
      find_labels_in_image(image, has_label);
      subtract_from_outside();
      find_level();
      balance();
    }
  }

  bool is_empty() const { return size[0] == 0; }

  Label_number label(std::size_t offset_in_box) const { return m_labels[offset_in_box]; }
  Label_number label_in_image(std::size_t offset_in_box) const { return m_in_image[offset_in_box]; }

  /// The box outside of which no voxel has a label, neither in the image nor by its scores; empty if no voxel
  /// of the image has it. \param label 0: all labels
  const Voxel_box& box(Label_number label) const
  {
    return label == 0 ? static_cast<const Voxel_box&>(*this) : m_indicators[label - 1];
  }

  /// How much better a label is in a voxel than another one.
  float lead(const std::array<std::size_t, 3>& voxel, Label_number label, Label_number other) const
  {
    return label == 0   ? m_outside[offset(voxel)] - level(other)
           : other == 0 ? level(label) - m_outside[offset(voxel)]
                        : score(voxel, label) - score(voxel, other);
  }

  /// Finds in which cubes, between a voxel of a row and the next voxels along all axes, labels are different.
  /// Nearly all have one label: a loop that is the same for all cubes is faster than to look at each of them.
  /// \param row first voxel
  /// \param differences one for each voxel, 0 for the last one and for cubes of one label
  void find_differences(std::size_t row, std::vector<Label_number>& differences) const
  {
    differences.assign(size[0], 0);
    const Label_number* const labels = m_labels.data() + row;
    for(std::size_t d = 1; d < 8; ++d) {
      const Label_number* const others = labels + m_steps[d];
      for(std::size_t i = 0; i + 1 < size[0]; ++i)
        differences[i] = Label_number(differences[i] | (labels[i] ^ others[i]));
    }
  }

  const Weights& weights() const { return m_weights; }

  void set_weights(const Weights& weights)
  {
    m_weights = weights;
    for(std::size_t l = 1; l < m_weights.size(); ++l)
      m_weights[l] = (std::min)(m_weights[l], largest_weight);
    find_best_labels();
  }

  /*!
  Lets labels not touch where they do not touch in the image: a layer of one voxel, of which smoothing leaves
  less than a voxel here and there, and which has diagonal gaps where it is no plane, would be full of holes.
  A place is a set of edges of the network's tetrahedra between the same two labels, each with a triangle in
  common with the next. It stays if both labels have a common face of voxels in the image at one of them;
  otherwise one end of each edge gets the best one of the other labels.
  */
  void seal_contacts()
  {
    constexpr int most_passes = 8; // a change can let others touch, a third of the places
    for(int pass = 0; pass < most_passes && seal_contacts_once(); ++pass) {
    }
  }

private:
  using Edge =
    std::pair<std::size_t, std::size_t>; // first voxel, and direction: bit i says whether along axis i

  bool seal_contacts_once()
  {
    m_is_known.assign(m_labels.size(), 0);
    std::vector<Edge> place;
    std::vector<Label_number> differences;
    bool is_changed = false;
    for(std::size_t k = 1; k + 1 < size[2]; ++k)
      for(std::size_t j = 1; j + 1 < size[1]; ++j) {
        const std::size_t row = offset({0, j, k});
        find_differences(row, differences);
        for(std::size_t i = 1; i + 1 < size[0]; ++i) {
          if(differences[i] == 0)
            continue;
          const std::size_t v = row + i;
          for(std::size_t d = 1; d < 8; ++d) {
            const Label_number a = m_labels[v], b = m_labels[v + m_steps[d]];
            if(a == b || (m_is_known[v] >> d & 1) != 0)
              continue;
            find_place({v, d}, place);
            if(std::any_of(place.begin(), place.end(),
                           [&](const Edge& e) { return touch_in_image(a, b, e); }))
              continue;
            is_changed = true;
            for(const Edge& edge : place)
              seal(edge, a, b);
            find_differences(row, differences);
          }
        }
      }
    return is_changed;
  }

  // Calls `f(voxel, edge from the first end, edge from the second end)` for each triangle at an edge.
  template <class F>
  void for_each_triangle_at(const Edge& edge, const F& f) const
  {
    const auto [v, d] = edge;
    const std::size_t w = v + m_steps[d];
    for(std::size_t e = 1; e < 8; ++e) {
      if((e & d) == e && e != d) // between both ends
        f(v + m_steps[e], Edge(v, e), Edge(v + m_steps[e], d ^ e));
      if((e & d) == 0) { // before the first end, and behind the second one
        f(v - m_steps[e], Edge(v - m_steps[e], e), Edge(v - m_steps[e], e | d));
        f(w + m_steps[e], Edge(v, d | e), Edge(w, e));
      }
    }
  }

  // Whether two labels have a common face of voxels in the image, a voxel away from an edge at most.
  bool touch_in_image(Label_number a, Label_number b, const Edge& edge) const
  {
    const std::array<std::size_t, 3> center = voxel(edge.first);
    std::array<std::size_t, 3> low, high;
    for(std::size_t i = 0; i < 3; ++i) {
      low[i] = (std::max)(center[i], std::size_t(1)) - 1;
      high[i] = (std::min)(center[i] + 1 + (edge.second >> i & 1), size[i] - 1);
    }
    for(std::size_t k = low[2]; k <= high[2]; ++k)
      for(std::size_t j = low[1]; j <= high[1]; ++j)
        for(std::size_t i = low[0]; i <= high[0]; ++i) {
          const std::array<std::size_t, 3> p{i, j, k};
          const Label_number first_label = m_in_image[offset(p)];
          if(first_label != a && first_label != b)
            continue;
          for(std::size_t axis = 0; axis < 3; ++axis)
            if(p[axis] < high[axis] && m_in_image[offset(p) + strides()[axis]] == (first_label == a ? b : a))
              return true;
        }
    return false;
  }

  // The edges between the same two labels that are connected by triangles.
  void find_place(const Edge& first, std::vector<Edge>& edges)
  {
    const Label_number a = m_labels[first.first], b = m_labels[first.first + m_steps[first.second]];
    const auto add = [&](const Edge& edge) {
      const auto bit = std::uint8_t(1 << edge.second);
      if((m_is_known[edge.first] & bit) != 0)
        return;
      m_is_known[edge.first] |= bit;
      edges.push_back(edge);
    };
    edges.clear();
    add(first);
    for(std::size_t i = 0; i < edges.size(); ++i) {
      const Edge edge = edges[i];
      const Label_number at_start = m_labels[edge.first];
      for_each_triangle_at(edge, [&](std::size_t v, const Edge& from_first, const Edge& from_second) {
        const Label_number label = m_labels[v];
        if(label == a || label == b)
          add(label == at_start ? from_second : from_first);
      });
    }
  }

  // Lets two labels not touch at an edge.
  void seal(const Edge& edge, Label_number a, Label_number b)
  {
    const std::size_t v = edge.first, w = v + m_steps[edge.second];
    if(m_labels[v] == m_labels[w] || (m_labels[v] != a && m_labels[v] != b)
       || (m_labels[w] != a && m_labels[w] != b))
      return; // sealed by another edge
    float best_ratio = 0;
    std::pair<std::size_t, Label_number> best{v, m_labels[v]};
    for(std::size_t label = 0; label <= m_indicators.size(); ++label) {
      if(label == a || label == b)
        continue;
      for(std::size_t end : {v, w}) {
        const float ratio = ratio_of_scores(end, Label_number(label), m_labels[end]);
        if(ratio > best_ratio) {
          best_ratio = ratio;
          best = {end, Label_number(label)};
        }
      }
    }
    m_labels[best.first] = best.second;
  }

  std::array<std::size_t, 3> voxel(std::size_t v) const
  {
    return {v % size[0], v / size[0] % size[1], v / (size[0] * size[1])};
  }

  static float odds(float share)
  {
    return share / (std::max)(1 - share, std::numeric_limits<float>::epsilon());
  }

  // Where the outside is less, a label may be.
  float level(Label_number label) const
  {
    const float highest_odds = m_weights[0] * m_weights[label];
    return highest_odds / (1 + highest_odds);
  }

  // The smoothed indicator of a label, times its weight.
  float score(const std::array<std::size_t, 3>& in_box, Label_number label) const
  {
    const Indicator& indicator = m_indicators[label - 1];
    std::array<std::size_t, 3> p;
    for(int i = 0; i < 3; ++i) {
      p[i] = std::size_t(std::int64_t(in_box[i]) + first[i] - indicator.first[i]); // wraps around if negative
      if(p[i] >= indicator.size[i])
        return 0;
    }
    return indicator.values[indicator.offset(p)] * m_weights[label];
  }

  // How many times as good as another one a label is in a voxel; 0 where nothing of it is.
  float ratio_of_scores(std::size_t v, Label_number label, Label_number other) const
  {
    if(label == 0)
      return odds(m_outside[v]) / (m_weights[0] * m_weights[other]);
    const std::array<std::size_t, 3> p = voxel(v);
    const float own = score(p, label);
    if(own == 0)
      return 0;
    return other == 0 ? m_weights[0] * m_weights[label] / odds(m_outside[v]) : own / score(p, other);
  }

  template <class HasLabel>
  void find_labels_in_image(const Voxel_image_3& image, const std::vector<HasLabel>& has_label)
  {
    m_in_image.assign(size[0] * size[1] * size[2], 0);
    // The label of the last value: most voxels have the value of the one before.
    float last_value = std::numeric_limits<float>::quiet_NaN();
    Label_number last_label = 0;
    for_each_in_image(*this, image.grid, [&](std::size_t v, std::size_t w) {
      const float value = image.values[w];
      if(value != last_value) {
        const auto found = std::find_if(has_label.begin(), has_label.end(),
                                        [value](const HasLabel& has) { return has(value); });
        last_value = value;
        last_label = found == has_label.end() ? Label_number(0) : Label_number(found - has_label.begin() + 1);
      }
      m_in_image[v] = last_label;
    });
  }

  // Makes the box large enough for all indicators, at whose borders are zeros, with a voxel around them.
  void surround_indicators()
  {
    std::array<std::int64_t, 3> last{};
    bool is_first = true;
    for(const Indicator& one : m_indicators) {
      if(one.values.empty())
        continue;
      for(int i = 0; i < 3; ++i) {
        const std::int64_t end = one.first[i] + std::int64_t(one.size[i]);
        first[i] = is_first ? one.first[i] : (std::min)(first[i], one.first[i]);
        last[i] = is_first ? end : (std::max)(last[i], end);
      }
      is_first = false;
    }
    if(is_first)
      return;
    for(int i = 0; i < 3; ++i) {
      --first[i];
      size[i] = std::size_t(last[i] + 1 - first[i]);
    }
  }

  // Calls `f(offset in the box, offset in the indicator)` for each voxel of an indicator.
  template <class F>
  void for_each_voxel_of(const Indicator& one, const F& f) const
  {
    for(std::size_t k = 0; k < one.size[2]; ++k)
      for(std::size_t j = 0; j < one.size[1]; ++j) {
        std::array<std::size_t, 3> p{0, j, k};
        const std::size_t own = one.offset(p);
        for(int i = 0; i < 3; ++i)
          p[i] += std::size_t(one.first[i] - first[i]);
        const std::size_t here = offset(p);
        for(std::size_t i = 0; i < one.size[0]; ++i)
          f(here + i, own + i);
      }
  }

  void subtract_from_outside()
  {
    m_outside.assign(size[0] * size[1] * size[2], 1.f);
    for(const Indicator& one : m_indicators)
      for_each_voxel_of(one, [&](std::size_t v, std::size_t own) { m_outside[v] -= one.values[own]; });
  }

  // A voxel is inside if the outside is less than the level of the best of all labels there. If only those
  // were compared that reach so far, one with a large weight would have all that is just outside of others.
  void find_best_labels()
  {
    m_best.assign(m_outside.size(), 0);
    m_second_best = m_best;
    m_labels.assign(m_outside.size(), 0);
    for(std::size_t l = 0; l < m_indicators.size(); ++l)
      for_each_voxel_of(m_indicators[l], [&, l](std::size_t v, std::size_t own) {
        const float score = m_indicators[l].values[own] * m_weights[l + 1];
        if(score > m_best[v]) {
          m_second_best[v] = std::exchange(m_best[v], score);
          m_labels[v] = Label_number(l + 1);
        } else {
          m_second_best[v] = (std::max)(m_second_best[v], score);
        }
      });
    for(std::size_t v = 0; v < m_labels.size(); ++v)
      if(m_labels[v] > 0 && m_outside[v] >= level(m_labels[v]))
        m_labels[v] = 0;
  }

  void find_level()
  {
    std::vector<float> values = m_outside;
    const auto inside = std::size_t(std::accumulate(m_numbers.begin(), m_numbers.end(), std::size_t(0)));
    const auto next = values.begin() + std::ptrdiff_t((std::min)(inside, values.size() - 1));
    std::nth_element(values.begin(), next, values.end());
    const float level = next == values.begin() ? 0 : (*next + *std::max_element(values.begin(), next)) / 2;
    m_weights[0] = odds(level);
  }

  // Changes the weights until each label is the best one of about as many voxels as have it. Two labels that
  // meet share the change, half each.
  void balance()
  {
    // A head of five labels and 28 nuclei are balanced in round 3; with an accuracy of 0.001, the head is in
    // round 4, and with 0.02 in round 2.
    constexpr int most_rounds = 12;
    constexpr double accuracy = 0.002;
    for(int round = 0;; ++round) {
      find_best_labels();
      std::vector<std::size_t> numbers(m_numbers.size(), 0);
      for(Label_number l : m_labels)
        if(l > 0)
          ++numbers[l - 1];
      bool is_balanced = true;
      for(std::size_t l = 0; l < numbers.size(); ++l)
        is_balanced = is_balanced
                      && std::abs(double(numbers[l]) - double(m_numbers[l]))
                           <= accuracy * double(m_numbers[l]);
      if(is_balanced || round == most_rounds)
        return;
      for(std::size_t l = 0; l < numbers.size(); ++l)
        if(m_numbers[l] > 0)
          m_weights[l + 1] = (std::min)(std::sqrt(m_weights[l + 1] * balancing_weight(l)), largest_weight);
    }
  }

  // The weight with which a label is the best one of as many voxels as have it, if the others keep theirs.
  float balancing_weight(std::size_t l) const
  {
    std::vector<float> needed; // to be the best, and inside
    for_each_voxel_of(m_indicators[l], [&](std::size_t v, std::size_t own) {
      const float value = m_indicators[l].values[own];
      if(value > 0) {
        const bool is_best = value * m_weights[l + 1] >= m_best[v];
        needed.push_back(
          (std::max)((is_best ? m_second_best[v] : m_best[v]) / value, odds(m_outside[v]) / m_weights[0]));
      }
    });
    if(needed.empty())
      return m_weights[l + 1];
    const auto next = needed.begin() + std::ptrdiff_t((std::min)(m_numbers[l], needed.size() - 1));
    std::nth_element(needed.begin(), next, needed.end());
    const float weight = next == needed.begin() ? *next
                                                : (*next + *std::max_element(needed.begin(), next)) / 2;
    return std::isfinite(weight) && weight > 0 ? weight : m_weights[l + 1];
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_LABEL_SCORES_H
