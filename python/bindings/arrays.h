// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conversion between arrays of NumPy and types of the library.

#ifndef MIXED_MESH_3_PYTHON_ARRAYS_H
#define MIXED_MESH_3_PYTHON_ARRAYS_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Surface_mesh.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace py = pybind11;
namespace mm3 = CGAL::Mixed_meshes_3;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Vector = mm3::Vec3;

// Arrays of other types and orders are converted, except numbers with fractions to integers.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style>;
using Marks = py::array_t<bool, py::array::c_style | py::array::forcecast>;

/// (n, 3) numbers. \throw std::invalid_argument for another shape
std::vector<Vector> vectors_of(const Doubles& array, const std::string& name);

/// The same as an array.
py::array_t<double> array_of(const std::vector<Vector>& vectors);

/// The vertices of faces, (n, 4), the last one -1 of triangles.
py::array_t<std::int64_t> array_of(const std::vector<mm3::Face>& faces);

/// An array of n truth values.
std::vector<bool> marks_of(const Marks& array, std::size_t n, const std::string& name);

py::array_t<bool> array_of(const std::vector<bool>& marks);

/// A closed surface, repaired as far as possible.
/// \throw std::invalid_argument names the defect
Surface surface_of(const Doubles& points, const Integers& triangles, const std::string& name,
                   std::vector<std::string>& warnings);

/// A surface that need not enclose anything.
/// \throw std::invalid_argument names the defect
Surface sheet_of(const Doubles& points, const Integers& triangles, const std::string& name,
                 std::vector<std::string>& warnings);

/// (n, 3) points and (m, 3) triangles of a surface, without unused entries.
py::tuple arrays_of(const Surface& surface);

// Functions of the parts of the module, which add their names to it.
void add_mesh(py::module_& module);
void add_meshing(py::module_& module);
void add_elasticity(py::module_& module);
void add_images(py::module_& module);
void add_patches(py::module_& module);

#endif // MIXED_MESH_3_PYTHON_ARRAYS_H
