// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_LABEL_NETWORK_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_LABEL_NETWORK_H

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_image_3/internal/Label_scores.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The triangles between labels: those around one label are a closed surface.
struct Label_network
{
  struct Triangle
  {
    std::array<std::uint32_t, 3> vertices; // outward oriented for the first label
    std::array<Label_number, 2> labels;    // ascending
  };

  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

struct Volume_and_area
{
  double volume = 0, area = 0;
};

/// The volumes and areas of labels, and the outside.
inline std::vector<Volume_and_area> measures(const Label_network& network, std::size_t number_of_labels)
{
  std::vector<Volume_and_area> result(number_of_labels + 1);
  for(const Label_network::Triangle& t : network.triangles) {
    const Vec3& origin = network.points.front();
    const Vec3 a = network.points[t.vertices[0]] - origin, b = network.points[t.vertices[1]] - origin,
               c = network.points[t.vertices[2]] - origin;
    const double volume = dot(a, cross(b, c)) / 6, area = norm(cross(b - a, c - a)) / 2;
    for(std::size_t side : {0, 1}) {
      result[t.labels[side]].volume += side == 0 ? volume : -volume;
      result[t.labels[side]].area += area;
    }
  }
  return result;
}

/*!
Makes the network of labels in a box of voxels. Each cube between eight centers of voxels is split into six
tetrahedra around one diagonal (Kuhn); an edge between voxels of different labels has a vertex where both
scores are equal. A tetrahedron with two labels has one triangle or two. In one with more, the three parts of
a face with three labels meet at a vertex of the face, and the network is the cone of its edges in faces to a
vertex in the tetrahedron.

So, whatever the labels are, triangles only meet in vertices and edges, and the surface around a label is a
closed 2-manifold: it separates the voxels that have the label from the others in each tetrahedron.
*/
class Label_network_maker
{
  using Voxel = std::array<std::size_t, 3>;
  using Index = std::uint32_t;

  // Corner of a cube: bit i says whether index i is larger by 1.
  struct Corner
  {
    Voxel voxel;
    int bits;
    Label_number label;
  };
  using Tetrahedron = std::array<Corner, 4>; // ascending

  // Least distance of vertices from the ends of an edge, in edges: an error of one hundredth of a voxel; and
  // from an end where its label is one voxel thick: a layer is half as thick as a voxel at least, where its
  // score is hardly the best one, or where it has been sealed.
  static constexpr double least_share = 0.01, least_share_in_layer = 0.25;
  static constexpr Index none = Index(-1);

  const Label_scores& m_scores;
  // Vertices on edges from a slice of the box and from the next one, by the edge's first end in the slice and
  // its direction: eight times as many as ends.
  std::array<std::vector<Index>, 2> m_on_edges;
  std::unordered_map<std::uint64_t, Index> m_in_faces; // by the first corner and the directions to the others
  Label_network m_network;

public:
  explicit Label_network_maker(const Label_scores& scores) : m_scores(scores) {}

  /// Makes the network; points are in indices of the image. The next call replaces it, and uses its memory
  /// again.
  Label_network& operator()()
  {
    const Voxel& size = m_scores.size;
    m_network.points.clear();
    m_network.triangles.clear();
    m_in_faces.clear();
    std::vector<Label_number> differences;
    for(std::vector<Index>& slice : m_on_edges)
      slice.assign(8 * size[0] * size[1], none);
    for(std::size_t k = 0; k + 1 < size[2]; ++k) {
      for(std::size_t j = 0; j + 1 < size[1]; ++j) {
        m_scores.find_differences(m_scores.offset({0, j, k}), differences);
        for(std::size_t i = 0; i + 1 < size[0]; ++i)
          if(differences[i] != 0)
            march({i, j, k});
      }
      m_on_edges[0].swap(m_on_edges[1]);
      std::fill(m_on_edges[1].begin(), m_on_edges[1].end(), none);
    }
    for(Vec3& p : m_network.points)
      for(std::size_t i = 0; i < 3; ++i)
        p[i] += double(m_scores.first[i]);
    return m_network;
  }

private:
  static Vec3 position(const Corner& c)
  {
    return {double(c.voxel[0]), double(c.voxel[1]), double(c.voxel[2])};
  }

  // Cuts a cube whose corners have different labels.
  void march(const Voxel& cube)
  {
    std::array<Corner, 8> corners;
    for(int c = 0; c < 8; ++c) {
      Voxel v = cube;
      for(int i = 0; i < 3; ++i)
        v[std::size_t(i)] += std::size_t(c >> i & 1);
      corners[std::size_t(c)] = {v, c, m_scores.label(m_scores.offset(v))};
    }
    constexpr int orders[6][2] = {{1, 3}, {2, 6}, {4, 5}, {1, 5}, {4, 6}, {2, 3}}; // from corner 0 to 7
    for(const auto& [first, second] : orders)
      cut({corners[0], corners[std::size_t(first)], corners[std::size_t(second)], corners[7]}, cube);
  }

  void cut(const Tetrahedron& t, const Voxel& cube)
  {
    std::array<Label_number, 4> labels{t[0].label, t[1].label, t[2].label, t[3].label};
    std::sort(labels.begin(), labels.end());
    const auto number = std::unique(labels.begin(), labels.end()) - labels.begin();
    if(number == 2)
      separate(t, cube);
    else if(number > 2)
      add_cone(t, cube);
  }

  // The triangle or the two triangles between two labels.
  void separate(const Tetrahedron& t, const Voxel& cube)
  {
    std::array<const Corner*, 4> in, out;
    std::size_t number_in = 0, number_out = 0;
    for(const Corner& c : t)
      (c.label == t[0].label ? in[number_in++] : out[number_out++]) = &c;
    const auto vertex = [&](std::size_t i, std::size_t o) { return on_edge(*in[i], *out[o], cube); };
    if(number_in == 1) {
      add(vertex(0, 0), vertex(0, 1), vertex(0, 2), *in[0], *out[0]);
    } else if(number_out == 1) {
      add(vertex(0, 0), vertex(1, 0), vertex(2, 0), *in[0], *out[0]);
    } else {
      const Index a = vertex(0, 0), b = vertex(0, 1), c = vertex(1, 1), d = vertex(1, 0);
      add(a, b, c, *in[0], *out[0]);
      add(a, c, d, *in[0], *out[0]);
    }
  }

  void add_cone(const Tetrahedron& t, const Voxel& cube)
  {
    Vec3 sum{};
    double number = 0;
    for(std::size_t i = 0; i < 4; ++i)
      for(std::size_t j = 0; j < i; ++j)
        if(t[i].label != t[j].label) {
          sum = sum + m_network.points[on_edge(t[i], t[j], cube)];
          ++number;
        }
    const Index apex = add_point(1 / number * sum);
    for(std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<const Corner*, 3> f;
      for(std::size_t i = 0, n = 0; i < 4; ++i)
        if(i != left_out)
          f[n++] = &t[i];
      for(std::size_t i = 0; i < 3; ++i) {
        const Corner &a = *f[i], &b = *f[(i + 1) % 3], &c = *f[(i + 2) % 3];
        if(a.label != b.label && a.label != c.label && b.label == c.label)
          add(apex, on_edge(a, b, cube), on_edge(a, c, cube), a, b);
        else if(a.label != b.label && a.label != c.label && b.label != c.label)
          add(apex, in_face(f, cube), on_edge(a, b, cube), a, b);
      }
    }
  }

  Index add_point(const Vec3& p)
  {
    m_network.points.push_back(p);
    return Index(m_network.points.size() - 1);
  }

  Index on_edge(const Corner& a, const Corner& b, const Voxel& cube)
  {
    const Corner &p = a.bits < b.bits ? a : b, &q = a.bits < b.bits ? b : a;
    Index& vertex = m_on_edges[p.voxel[2] - cube[2]][8 * (p.voxel[0] + m_scores.size[0] * p.voxel[1])
                                                     + std::size_t(q.bits - p.bits)];
    if(vertex == none) {
      const double u = m_scores.lead(p.voxel, p.label, q.label), v = m_scores.lead(q.voxel, q.label, p.label);
      const double share = u + v > 0 ? u / (u + v) : 0.5,
                   least = is_layer(p, q) ? least_share_in_layer : least_share,
                   least_behind = is_layer(q, p) ? least_share_in_layer : least_share;
      vertex = add_point(
        position(p) + (std::min)((std::max)(share, least), 1 - least_behind) * (position(q) - position(p)));
    }
    return vertex;
  }

  // Whether the label of the voxel `p` is one voxel thick where an edge to `q` passes.
  bool is_layer(const Corner& p, const Corner& q) const
  {
    Voxel before;
    for(std::size_t i = 0; i < 3; ++i) {
      before[i] = 2 * p.voxel[i] - q.voxel[i]; // wraps around if negative
      if(before[i] >= m_scores.size[i])
        return false;
    }
    return m_scores.label(m_scores.offset(before)) != p.label;
  }

  Index in_face(const std::array<const Corner*, 3>& f, const Voxel& cube)
  {
    const std::uint64_t key = m_scores.offset(f[0]->voxel) << 6 | std::uint64_t(f[1]->bits - f[0]->bits) << 3
                              | std::uint64_t(f[2]->bits - f[0]->bits);
    const auto found = m_in_faces.find(key);
    if(found != m_in_faces.end())
      return found->second;
    Vec3 sum{};
    for(std::size_t i = 0; i < 3; ++i)
      sum = sum + m_network.points[on_edge(*f[i], *f[(i + 1) % 3], cube)];
    return m_in_faces[key] = add_point(1. / 3 * sum);
  }

  // Adds a triangle between the parts of two corners.
  void add(Index a, Index b, Index c, const Corner& in, const Corner& out)
  {
    const Corner& first = in.label < out.label ? in : out;
    const std::vector<Vec3>& p = m_network.points;
    if(dot(cross(p[b] - p[a], p[c] - p[a]), position(first) - p[a]) > 0)
      std::swap(b, c);
    m_network.triangles.push_back(
      {{a, b, c}, {(std::min)(in.label, out.label), (std::max)(in.label, out.label)}});
  }
};

/// Makes the network of scores, whose weights are changed such that each label has the volume of its voxels.
/// \param deviations deviations of the Gaussian, in voxels along each axis
inline Label_network balanced_network(Label_scores& scores, const std::vector<Label_extent_3>& extents,
                                      const std::array<double, 3>& deviations)
{
  // A head of five labels is balanced in round 8, 28 nuclei in round 3. With 4 rounds, the relative errors of
  // the head's labels add up to 0.034 instead of 0.017.
  constexpr int most_rounds = 8;
  constexpr double accuracy = 0.01, resolution = 0.5; // relative, and in voxels
  // The logarithm of the ratio of two indicators changes by 4 / sqrt(2 pi) in a deviation where two labels
  // meet in a plane; both share the change. It is linear near the plane only: farther steps are cut short.
  constexpr double change_per_deviation = 0.8, longest_step = 0.25;
  const double deviation = std::cbrt(deviations[0] * deviations[1] * deviations[2]);
  const std::size_t n = extents.size() + 1;                     // with the outside
  std::vector<double> wanted(n, 0), lacks(n, 0), damping(n, 1); // 0 is all that is inside
  for(std::size_t l = 1; l < n; ++l) {
    wanted[l] = double(extents[l - 1].number_of_voxels);
    wanted[0] += wanted[l];
  }
  Label_scores::Weights best = scores.weights();
  double least_error = std::numeric_limits<double>::infinity();
  Label_network_maker make(scores);
  for(int round = 0;; ++round) {
    scores.seal_contacts();
    Label_network& network = make();
    const std::vector<Volume_and_area> measured = measures(network, extents.size());
    double error = 0;
    bool is_balanced = true;
    Label_scores::Weights weights = scores.weights();
    for(std::size_t l = 0; l < n; ++l) {
      const double lack = wanted[l] - std::abs(measured[l].volume);
      error += wanted[l] != 0 ? std::abs(lack / wanted[l]) : 0;
      is_balanced = is_balanced
                    && (l == 0 || std::abs(lack) <= (std::max)(accuracy * wanted[l], resolution)
                        || weights[l] >= Label_scores::largest_weight);
      if(lack * lacks[l] < 0 && std::abs(lack) > std::abs(lacks[l]) / 2)
        damping[l] /= 2; // it would go on to oscillate
      lacks[l] = lack;
      if(measured[l].area > 0 && deviation > 0) {
        const double step = lack / measured[l].area / deviation;
        weights[l] *= float(std::exp(damping[l] * change_per_deviation
                                     * (std::min)((std::max)(step, -longest_step), longest_step)));
      }
    }
    const bool is_last = is_balanced || round >= most_rounds || deviation == 0;
    if(error < least_error) {
      least_error = error;
      best = scores.weights();
      if(is_last)
        return std::move(network);
    } else if(is_last) { // layers of a voxel may not converge: the best round is repeated
      scores.set_weights(best);
      scores.seal_contacts();
      return std::move(make());
    }
    scores.set_weights(weights);
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_LABEL_NETWORK_H
