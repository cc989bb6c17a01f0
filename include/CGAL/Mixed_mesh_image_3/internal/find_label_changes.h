// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_FIND_LABEL_CHANGES_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_FIND_LABEL_CHANGES_H

#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_image_3/Label_change_3.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/internal/Label_scores.h>
#include <CGAL/Mixed_mesh_image_3/internal/Voxel_runs.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Compares the topology of voxels before and after they are smoothed. Voxels after that are connected as their
surface of marching tetrahedra is. Before, voxels with an edge or a corner in common only may be connected or
not: nothing is a change that is none with one of both. So a body is parted if voxels with common faces are in
several pieces, and bodies are joined that do not even have a corner in common.
*/
class Label_change_finder
{
  using Mask = std::vector<std::uint8_t>;
  using Size = std::array<std::size_t, 3>;
  using Components = Voxel_runs::Components;
  using Kind = Label_change_kind;
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  // Voxels with a value: those of a label, or all others.
  struct Part
  {
    Voxel_runs runs;
    std::array<Components, 3> components; // by connectivity

    Part(const Size& size, const Mask& mask, std::uint8_t value) : runs(size, mask, value) {}
    void connect(Voxel_connectivity c) { components[std::size_t(c)] = runs.components(c); }
    const Components& connected(Voxel_connectivity c) const { return components[std::size_t(c)]; }
  };

  const Size m_size;
  const Mask& m_before;
  const Mask& m_after;
  std::vector<Label_change_3> m_changes;

public:
  /// \param before,after 1 in voxels that have the label. \pre no voxel at the border has it
  Label_change_finder(const Size& size, const Mask& before, const Mask& after)
    : m_size(size), m_before(before), m_after(after)
  {
  }

  /// Finds changes; points are indices in the box.
  /// \param has_cavities whether cavities are examined: those of one label may be bodies of others
  std::vector<Label_change_3> operator()(bool has_cavities)
  {
    using Connectivity = Voxel_connectivity;
    Part solid_before(m_size, m_before, 1), solid_after(m_size, m_after, 1), void_before(m_size, m_before, 0),
      void_after(m_size, m_after, 0);
    for(const auto c : {Connectivity::FACES, Connectivity::TETRAHEDRA, Connectivity::CORNERS}) {
      solid_before.connect(c);
      void_before.connect(c);
    }
    solid_after.connect(Connectivity::TETRAHEDRA);
    void_after.connect(Connectivity::TETRAHEDRA);
    compare(solid_before, solid_after,
            {Kind::BODIES_LOST, Kind::BODIES_PARTED, Kind::BODIES_JOINED, Kind::BODIES_ADDED});
    if(solid_after.runs.runs().empty())
      return std::move(m_changes);
    if(has_cavities)
      compare(void_before, void_after,
              {Kind::CAVITIES_LOST, Kind::CAVITIES_PARTED, Kind::CAVITIES_JOINED, Kind::CAVITIES_ADDED});
    compare_handles(solid_before, solid_after, void_before, void_after);
    return std::move(m_changes);
  }

private:
  // The components of both that have voxels in common.
  static Pairs common(const Voxel_runs& first, const Components& in_first, const Voxel_runs& second,
                      const Components& in_second)
  {
    Pairs pairs;
    Voxel_runs::for_each_common(first, second, [&](std::size_t r, std::size_t s) {
      const std::pair<std::uint32_t, std::uint32_t> pair{in_first.of_run[r], in_second.of_run[s]};
      if(pairs.empty() || pairs.back() != pair)
        pairs.push_back(pair);
    });
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  // The numbers of components that have several partners, and of all these.
  static std::pair<std::size_t, std::size_t> several(const Pairs& pairs)
  {
    std::size_t number = 0;
    std::vector<std::uint32_t> partners;
    for(std::size_t i = 0, end; i < pairs.size(); i = end) {
      for(end = i + 1; end < pairs.size() && pairs[end].first == pairs[i].first;)
        ++end;
      if(end == i + 1)
        continue;
      ++number;
      for(std::size_t j = i; j < end; ++j)
        partners.push_back(pairs[j].second);
    }
    std::sort(partners.begin(), partners.end());
    return {number, std::size_t(std::unique(partners.begin(), partners.end()) - partners.begin())};
  }

  // The components without partner.
  static std::vector<std::uint8_t> are_alone(const Components& components, const Pairs& pairs)
  {
    std::vector<std::uint8_t> result(components.number, 1);
    for(const auto& pair : pairs)
      result[pair.first] = 0;
    return result;
  }

  // \param kinds of what is lost, parted, joined, added
  void compare(const Part& before, const Part& after, const std::array<Kind, 4>& kinds)
  {
    const Components &strict = before.connected(Voxel_connectivity::FACES),
                     &loose = before.connected(Voxel_connectivity::CORNERS),
                     &smoothed = after.connected(Voxel_connectivity::TETRAHEDRA);
    const auto add = [&](std::size_t kind, std::size_t from, std::size_t to, const auto& place) {
      if(from + to > 0)
        m_changes.push_back({0, kinds[kind], from, to, place()});
    };
    const std::vector<std::uint8_t> lost = are_alone(loose, common(before.runs, loose, after.runs, smoothed)),
                                    added = are_alone(smoothed,
                                                      common(after.runs, smoothed, before.runs, loose));
    const auto parted = several(common(before.runs, strict, after.runs, smoothed));
    const auto joined = several(common(after.runs, smoothed, before.runs, loose));
    const auto number = [](const std::vector<std::uint8_t>& v) {
      return std::size_t(std::count(v.begin(), v.end(), 1));
    };
    add(0, number(lost), 0, [&] { return middle(before.runs, loose, lost); });
    add(1, parted.first, parted.second,
        [&] { return meeting(before.runs, after.runs, smoothed, Voxel_connectivity::FACES); });
    add(2, joined.second, joined.first,
        [&] { return meeting(after.runs, before.runs, loose, Voxel_connectivity::TETRAHEDRA); });
    add(3, 0, number(added), [&] { return middle(after.runs, smoothed, added); });
  }

  // The number of handles is that of bodies and cavities, minus the Euler characteristic.
  static std::size_t number_of_handles(const Part& solid, const Part& voids,
                                       const std::array<std::size_t, 256>& counts,
                                       Voxel_connectivity connectivity)
  {
    using Connectivity = Voxel_connectivity;
    const Connectivity of_voids = connectivity == Connectivity::FACES     ? Connectivity::CORNERS
                                  : connectivity == Connectivity::CORNERS ? Connectivity::FACES
                                                                          : Connectivity::TETRAHEDRA;
    return std::size_t(std::ptrdiff_t(solid.connected(connectivity).number)
                       + std::ptrdiff_t(voids.connected(of_voids).number) - 1 // without the outside
                       - euler_characteristic(counts, connectivity));
  }

  void compare_handles(const Part& solid_before, const Part& solid_after, const Part& void_before,
                       const Part& void_after)
  {
    const auto counts = pattern_counts(m_size, m_before);
    std::size_t least = std::numeric_limits<std::size_t>::max(), most = 0;
    for(const auto c :
        {Voxel_connectivity::FACES, Voxel_connectivity::TETRAHEDRA, Voxel_connectivity::CORNERS}) {
      const std::size_t number = number_of_handles(solid_before, void_before, counts, c);
      least = (std::min)(least, number);
      most = (std::max)(most, number);
    }
    const std::size_t number = number_of_handles(solid_after, void_after, pattern_counts(m_size, m_after),
                                                 Voxel_connectivity::TETRAHEDRA);
    if(number >= least && number <= most)
      return;
    Mask changed(m_before.size());
    for(std::size_t v = 0; v < changed.size(); ++v)
      changed[v] = m_before[v] != m_after[v];
    const Voxel_runs runs(m_size, changed, 1);
    const Components components = runs.components(Voxel_connectivity::FACES);
    const std::array<double, 3> point = middle(runs, components,
                                               std::vector<std::uint8_t>(components.number, 1));
    if(number < least)
      m_changes.push_back({0, Kind::HANDLES_LOST, least, number, point});
    else
      m_changes.push_back({0, Kind::HANDLES_ADDED, most, number, point});
  }

  std::array<double, 3> position(std::size_t v) const
  {
    return {double(v % m_size[0]), double(v / m_size[0] % m_size[1]), double(v / (m_size[0] * m_size[1]))};
  }

  // The voxel in the middle of the largest one of chosen components.
  std::array<double, 3> middle(const Voxel_runs& runs, const Components& components,
                               const std::vector<std::uint8_t>& is_chosen) const
  {
    std::vector<std::size_t> sizes(components.number);
    for(std::size_t r = 0; r < runs.runs().size(); ++r)
      if(is_chosen[components.of_run[r]] != 0)
        sizes[components.of_run[r]] += runs.runs()[r].end - runs.runs()[r].begin;
    const auto largest = std::size_t(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    const auto for_each_voxel = [&](const auto& f) {
      runs.for_each_voxel([&](std::size_t v, std::size_t r) {
        if(components.of_run[r] == largest)
          f(position(v));
      });
    };
    std::array<double, 3> sum{}, best{};
    for_each_voxel([&](const std::array<double, 3>& p) {
      for(std::size_t i = 0; i < 3; ++i)
        sum[i] += p[i] / double(sizes[largest]);
    });
    double least = std::numeric_limits<double>::infinity();
    for_each_voxel([&](const std::array<double, 3>& p) {
      const double distance = std::hypot(p[0] - sum[0], p[1] - sum[1], p[2] - sum[2]);
      if(distance < least) {
        least = distance;
        best = p;
      }
    });
    return best;
  }

  // The place where components, which grow in other voxels at the same rate, first meet: the middle of the
  // shortest way between two of them.
  // \param connectivity faces, or tetrahedra
  std::array<double, 3> meeting(const Voxel_runs& others, const Voxel_runs& runs,
                                const Components& components, Voxel_connectivity connectivity) const
  {
    constexpr std::uint32_t none = std::uint32_t(-1), no_component = std::uint32_t(-2);
    std::vector<std::uint32_t> numbers(m_before.size(), none);
    others.for_each_voxel([&](std::size_t v, std::size_t) { numbers[v] = no_component; });
    std::vector<std::size_t> found;
    runs.for_each_voxel([&](std::size_t v, std::size_t r) {
      if(numbers[v] == none)
        return;
      numbers[v] = components.of_run[r];
      found.push_back(v);
    });
    const std::array<std::size_t, 3> strides{1, m_size[0], m_size[0] * m_size[1]};
    for(std::size_t next = 0; next < found.size(); ++next) {
      const std::size_t v = found[next];
      for(std::size_t direction = 1; direction < 8; ++direction) {
        if(connectivity == Voxel_connectivity::FACES && (direction & (direction - 1)) != 0)
          continue; // not along an axis
        std::size_t step = 0;
        for(std::size_t axis = 0; axis < 3; ++axis)
          step += (direction >> axis & 1) * strides[axis];
        for(const std::size_t neighbor : {v - step, v + step}) { // wraps around if negative
          if(neighbor >= numbers.size() || numbers[neighbor] == none || numbers[neighbor] == numbers[v])
            continue;
          if(numbers[neighbor] != no_component)
            return position(neighbor);
          numbers[neighbor] = numbers[v];
          found.push_back(neighbor);
        }
      }
    }
    return position(found.empty() ? 0 : found.front());
  }
};

/// The changes of all labels together, and of each, between the image and the scores, on which surfaces are
/// based: each surface separates the voxels that have a label by their scores from all others.
inline std::vector<Label_change_3> find_label_changes(const Label_scores& scores,
                                                      std::size_t number_of_labels,
                                                      const Affine_map_3& index_to_world, unsigned threads)
{
  std::vector<std::vector<Label_change_3>> changes(number_of_labels + 1);
  parallel_for(
    number_of_labels + 1, threads,
    [&](std::size_t label) {
      const Voxel_box& box = scores.box(Label_number(label));
      if(box.size[0] == 0)
        return;
      std::vector<std::uint8_t> before, after;
      before.reserve(box.size[0] * box.size[1] * box.size[2]);
      after.reserve(before.capacity());
      const auto has_label = [label](Label_number l) { return label == 0 ? l != 0 : l == label; };
      std::array<std::size_t, 3> shift;
      for(std::size_t i = 0; i < 3; ++i)
        shift[i] = std::size_t(box.first[i] - scores.first[i]);
      for(std::size_t k = 0; k < box.size[2]; ++k)
        for(std::size_t j = 0; j < box.size[1]; ++j) {
          const std::size_t row = scores.offset({shift[0], j + shift[1], k + shift[2]});
          for(std::size_t v = row; v < row + box.size[0]; ++v) {
            before.push_back(has_label(scores.label_in_image(v)));
            after.push_back(has_label(scores.label(v)));
          }
        }
      // A cavity of one label that is none of all has bodies of other labels, which change themselves.
      changes[label] = Label_change_finder(box.size, before, after)(label == 0);
      for(Label_change_3& change : changes[label]) {
        change.label = label;
        for(std::size_t i = 0; i < 3; ++i)
          change.point[i] += double(box.first[i]);
        change.point = transform(index_to_world, change.point);
      }
    },
    1);
  std::vector<Label_change_3> result;
  for(const auto& of_label : changes)
    result.insert(result.end(), of_label.begin(), of_label.end());
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_FIND_LABEL_CHANGES_H
