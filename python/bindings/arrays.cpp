// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "arrays.h"

#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>

#include <algorithm>
#include <stdexcept>

namespace {

template <class T, class Triple>
py::array_t<T> array_of_triples(const std::vector<Triple>& triples)
{
  py::array_t<T> array({py::ssize_t(triples.size()), py::ssize_t(3)});
  if(!triples.empty())
    std::copy_n(triples.front().data(), 3 * triples.size(), array.mutable_data());
  return array;
}

// A surface by `make`, one of the library's functions for arrays.
template <class Make>
Surface make_surface_with(const Make& make, const Doubles& points, const Integers& triangles,
                          const std::string& name, std::vector<std::string>& warnings)
{
  if(triangles.ndim() != 2)
    throw std::invalid_argument(name + ": expected triangles of shape (n, 3)");
  std::vector<std::vector<std::int64_t>> polygons;
  const auto rows = triangles.unchecked<2>();
  for(py::ssize_t i = 0; i < rows.shape(0); ++i)
    polygons.emplace_back(&rows(i, 0), &rows(i, 0) + rows.shape(1));
  const std::vector<Vector> coordinates = vectors_of(points, name);
  Surface surface;
  std::string error;
  mm3::IO::Surface_input input;
  bool is_made;
  {
    const py::gil_scoped_release release;
    is_made = make(coordinates, polygons, name, mm3::IO::Read_surface_options(), surface, &error, &input);
  }
  if(!is_made)
    throw std::invalid_argument(error);
  for(const std::string& warning : input.warnings)
    warnings.push_back(name + ": " + warning);
  return surface;
}

} // namespace

std::vector<Vector> vectors_of(const Doubles& array, const std::string& name)
{
  if(array.ndim() != 2 || array.shape(1) != 3)
    throw std::invalid_argument(name + ": expected an array of shape (n, 3)");
  std::vector<Vector> vectors;
  const auto rows = array.unchecked<2>();
  for(py::ssize_t i = 0; i < rows.shape(0); ++i)
    vectors.push_back({rows(i, 0), rows(i, 1), rows(i, 2)});
  return vectors;
}

py::array_t<double> array_of(const std::vector<Vector>& vectors) { return array_of_triples<double>(vectors); }

py::array_t<std::int64_t> array_of(const std::vector<mm3::Face>& faces)
{
  py::array_t<std::int64_t> array({py::ssize_t(faces.size()), py::ssize_t(4)});
  auto rows = array.mutable_unchecked<2>();
  for(std::size_t f = 0; f < faces.size(); ++f)
    for(int i = 0; i < 4; ++i)
      rows(py::ssize_t(f), i) = i < faces[f].vertices().size() ? std::int64_t(faces[f].vertices()[i]) : -1;
  return array;
}

std::vector<bool> marks_of(const Marks& array, std::size_t n, const std::string& name)
{
  if(array.ndim() != 1 || std::size_t(array.shape(0)) != n)
    throw std::invalid_argument(name + ": expected " + std::to_string(n) + " truth values");
  return std::vector<bool>(array.data(), array.data() + n);
}

py::array_t<bool> array_of(const std::vector<bool>& marks)
{
  py::array_t<bool> array(py::ssize_t(marks.size()));
  std::copy(marks.begin(), marks.end(), array.mutable_data());
  return array;
}

Surface surface_of(const Doubles& points, const Integers& triangles, const std::string& name,
                   std::vector<std::string>& warnings)
{
  return make_surface_with([](auto&&... arguments) { return mm3::IO::make_closed_surface(arguments...); },
                           points, triangles, name, warnings);
}

Surface sheet_of(const Doubles& points, const Integers& triangles, const std::string& name,
                 std::vector<std::string>& warnings)
{
  return make_surface_with([](auto&&... arguments) { return mm3::IO::make_sheet(arguments...); }, points,
                           triangles, name, warnings);
}

py::tuple arrays_of(const Surface& surface)
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::int64_t, 3>> triangles;
  CGAL::Polygon_mesh_processing::polygon_mesh_to_polygon_soup(surface, points, triangles);
  return py::make_tuple(array_of_triples<double>(points), array_of_triples<std::int64_t>(triangles));
}
