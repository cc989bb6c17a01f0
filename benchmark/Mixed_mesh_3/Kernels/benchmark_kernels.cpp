// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nanoseconds an element, for each kind: its cost, its cost with the gradient by a vertex, the cost after a
// move of the vertex as in a line search, the certificate, the proof of the quality bound, and the matrix
// with linear and with quadratic displacements. Elements are ideal ones, distorted at random.
//
//   benchmark_kernels [options of Google Benchmark, such as --benchmark_filter=hexahedron]

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/fem/element_stiffness.h>
#include <CGAL/Mixed_mesh_3/internal/fem/quadrature.h>
#include <CGAL/Mixed_mesh_3/quality_bound.h>

#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

using Element = std::array<mm3::Vec3, 8>;
using Coordinates = std::array<std::array<double, 3>, 8>;

constexpr std::size_t number_of_elements = 1024; // fit into the second cache

// The reference element, of unit edges, with vertices moved by up to a fifth.
std::vector<Element> distorted_elements(mm3::Element_kind kind)
{
  static constexpr double points[mm3::number_of_element_kinds][8][3] = {
    {{0, 0, 0}, {1, 0, 0}, {0.5, 0.87, 0}, {0.5, 0.29, 0.82}},
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.8}},
    {{0, 0, 0}, {1, 0, 0}, {0.5, 0.87, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, 0.87, 1}},
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  std::mt19937 random(1);
  const auto shift = [&random] { return 0.4 * (double(random()) / double(std::mt19937::max()) - 0.5); };
  std::vector<Element> elements(number_of_elements);
  for(Element& element : elements)
    for(int i = 0; i < mm3::reference_elements[kind].number_of_vertices; ++i)
      for(int k = 0; k < 3; ++k)
        element[std::size_t(i)][std::size_t(k)] = points[kind][i][k] + shift();
  return elements;
}

// Measures `evaluate(kind, element, number)`; the time is that of an element.
template <class Evaluate>
void add(const std::string& name, const Evaluate& evaluate)
{
  for(mm3::Element_kind kind : mm3::element_kinds)
    benchmark::RegisterBenchmark((name + "/" + mm3::reference_elements[kind].name).c_str(),
                                 [kind, evaluate](benchmark::State& state) {
                                   const std::vector<Element> elements = distorted_elements(kind);
                                   std::size_t i = 0;
                                   for(auto _ : state) {
                                     benchmark::DoNotOptimize(evaluate(kind, elements[i], i));
                                     i = (i + 1) % number_of_elements;
                                   }
                                 });
}

Coordinates coordinates(const Element& element)
{
  Coordinates result;
  for(std::size_t i = 0; i < element.size(); ++i)
    result[i] = element[i];
  return result;
}

} // namespace

int main(int argc, char* argv[])
{
  const mm3::Aspect_ratio_quality_3 quality;
  const auto vertex = [](mm3::Element_kind kind, std::size_t i) {
    return int(i % std::size_t(mm3::reference_elements[kind].number_of_vertices));
  };
  add("cost", [quality](mm3::Element_kind kind, const Element& p, std::size_t) { return quality(kind, p); });
  add("cost and gradient", [quality, vertex](mm3::Element_kind kind, const Element& p, std::size_t i) {
    mm3::Vec3 gradient;
    return quality(kind, p, vertex(kind, i), gradient) + gradient[0];
  });
  add("cost after a move", [quality, vertex](mm3::Element_kind kind, const Element& p, std::size_t i) {
    // Parts of the wrong element cost as much as those of the right one.
    static mm3::internal::Aspect_ratio_parts parts = [&] {
      mm3::Vec3 gradient;
      mm3::internal::Aspect_ratio_parts first{};
      quality(mm3::HEXAHEDRON, distorted_elements(mm3::HEXAHEDRON)[0], 0, gradient, first);
      return first;
    }();
    return quality.cost_after_move(kind, p, vertex(kind, i), parts);
  });
  add("certificate", [](mm3::Element_kind kind, const Element& p, std::size_t) {
    return mm3::jacobian_sign(kind, coordinates(p));
  });
  add("bound", [](mm3::Element_kind kind, const Element& p, std::size_t) {
    return mm3::is_aspect_ratio_at_most(kind, coordinates(p), 3.2);
  });
  for(int order : {1, 2})
    add(order == 1 ? "element matrix" : "element matrix of order 2",
        [order](mm3::Element_kind kind, const Element& p, std::size_t) {
          static mm3::internal::Element_stiffness stiffness;
          mm3::internal::compute_element_stiffness(mm3::internal::quadrature_rule(kind, order), p,
                                                   mm3::Elastic_material(),
                                                   mm3::internal::Dilatation::POINTWISE, stiffness);
          return stiffness[0][0][0][0];
        });
  benchmark::Initialize(&argc, argv);
  if(benchmark::ReportUnrecognizedArguments(argc, argv))
    return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
