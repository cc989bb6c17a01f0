// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh as arrays, its certificate and its quality.

#include "arrays.h"

#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/certify_mesh.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <CGAL/version.h>

#include <pybind11/stl.h>

#include <memory>
#include <stdexcept>

namespace {

using Kinds = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

std::shared_ptr<Mesh> mesh_of_arrays(const Doubles& points, const Kinds& kinds, const Integers& connectivity,
                                     const std::optional<Integers>& labels,
                                     const std::optional<Marks>& in_region)
{
  auto mesh = std::make_shared<Mesh>();
  for(const Vector& p : vectors_of(points, "points"))
    mesh->add_vertex({p[0], p[1], p[2]});
  if(kinds.ndim() != 1 || connectivity.ndim() != 1)
    throw std::invalid_argument("kinds, connectivity: expected arrays of one dimension");
  if(labels && (labels->ndim() != 1 || labels->shape(0) != kinds.shape(0)))
    throw std::invalid_argument("labels: expected one for each element");
  const auto is_in_region = in_region ? marks_of(*in_region, std::size_t(kinds.shape(0)), "in_region")
                                      : std::vector<bool>(std::size_t(kinds.shape(0)), false);
  py::ssize_t next = 0;
  for(py::ssize_t e = 0; e < kinds.shape(0); ++e) {
    const std::string name = "element " + std::to_string(e);
    if(kinds.at(e) >= mm3::number_of_element_kinds)
      throw std::invalid_argument(name + " has the kind " + std::to_string(int(kinds.at(e)))
                                  + "; expected 0 to 3");
    const auto kind = mm3::Element_kind(kinds.at(e));
    std::vector<mm3::Vertex_index> vertices;
    for(int i = 0; i < mm3::reference_elements[kind].number_of_vertices; ++i, ++next) {
      if(next >= connectivity.shape(0))
        throw std::invalid_argument("connectivity: ends before the elements do");
      const std::int64_t v = connectivity.at(next);
      if(v < 0 || std::size_t(v) >= mesh->number_of_vertices())
        throw std::invalid_argument(name + " has the vertex " + std::to_string(v) + ", which does not exist");
      vertices.push_back(mm3::Vertex_index(v));
    }
    mm3::Element_attributes attributes;
    attributes.is_in_region = is_in_region[std::size_t(e)];
    if(labels) {
      if(labels->at(e) < 1 || labels->at(e) > 2000000000)
        throw std::invalid_argument(name + " has the label " + std::to_string(labels->at(e))
                                    + "; expected 1 or more");
      attributes.subdomain_index = mm3::Subdomain_index(labels->at(e));
    }
    mesh->add_element(kind, vertices, attributes);
  }
  if(next != connectivity.shape(0))
    throw std::invalid_argument("connectivity: goes on after the last element");
  return mesh;
}

// Arrays that refer to the mesh, which lives as long as the arrays, and does not change.
template <class T>
py::array view_of(const T* data, std::vector<py::ssize_t> shape, const py::object& owner)
{
  py::array_t<T> array(std::move(shape), data, owner);
  array.attr("flags").attr("writeable") = false;
  return std::move(array);
}

// The getter of a property: the values that `get` takes from an Element_list, as an array of type T.
template <class T, class Get>
auto view_of_elements(const Get& get)
{
  return [get](const py::object& self) {
    const auto& values = get(self.cast<const Mesh&>().elements());
    return view_of(reinterpret_cast<const T*>(values.data()), {py::ssize_t(values.size())}, self);
  };
}

template <class T, class Of_element>
py::array_t<T> of_elements(const Mesh& mesh, const Of_element& of_element)
{
  py::array_t<T> array(py::ssize_t(mesh.number_of_elements()));
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e)
    array.mutable_data()[e] = of_element(e);
  return array;
}

// For each element, whether its Jacobian is proved positive on the whole element.
py::array_t<bool> certify(const Mesh& mesh)
{
  std::vector<bool> is_positive(mesh.number_of_elements());
  {
    const py::gil_scoped_release release;
    for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e)
      is_positive[e] = mm3::jacobian_sign(mesh, e) == mm3::Jacobian_sign::POSITIVE;
  }
  return array_of(is_positive);
}

py::dict defects(const Mesh& mesh)
{
  mm3::Mesh_certificate certificate;
  {
    const py::gil_scoped_release release;
    certificate = mm3::certify_mesh(mesh);
  }
  const mm3::Mesh_defects& d = certificate.defects;
  py::dict result;
  result["nonconforming faces"] = d.nonconforming_faces;
  result["nonmanifold boundary edges"] = d.nonmanifold_boundary_edges;
  result["nonmanifold boundary vertices"] = d.nonmanifold_boundary_vertices;
  result["nonpositive elements"] = d.nonpositive_elements;
  result["undecided elements"] = d.undecided_elements;
  result["unused vertices"] = d.unused_vertices;
  result["duplicate vertices"] = d.duplicate_vertices;
  result["boundary self-intersections"] = certificate.number_of_self_intersections;
  return result;
}

py::array_t<double> quality(const Mesh& mesh, const std::string& measure)
{
  if(measure == "ARC")
    return of_elements<double>(mesh, [&](std::size_t e) { return mm3::aspect_ratio_coefficient(mesh, e); });
  if(measure == "scaled Jacobian")
    return of_elements<double>(mesh, [&](std::size_t e) { return mm3::scaled_jacobian(mesh, e); });
  if(measure == "volume")
    return of_elements<double>(mesh, [&](std::size_t e) { return mm3::volume(mesh, e); });
  throw std::invalid_argument("quality: unknown measure '" + measure
                              + "'; expected ARC, scaled Jacobian or volume");
}

void save(const Mesh& mesh, const std::string& path, int order, bool has_only_tetrahedra)
{
  mm3::IO::Write_options options;
  options.order = order;
  options.tetrahedra = has_only_tetrahedra;
  std::string error;
  bool is_written;
  {
    const py::gil_scoped_release release;
    is_written = mm3::IO::write_mixed_mesh(path, mesh, options, &error);
  }
  if(!is_written)
    throw std::invalid_argument(error);
}

// The table of element kinds, from which the page of a mesh computes the faces to draw.
py::list element_kinds()
{
  py::list kinds;
  for(const mm3::Reference_element& kind : mm3::reference_elements) {
    py::list faces;
    for(int f = 0; f < kind.number_of_faces; ++f) {
      const mm3::Element_face& face = kind.faces[f];
      faces.append(std::vector<int>(face.vertices, face.vertices + face.size));
    }
    py::dict row;
    row["name"] = kind.name;
    row["plural"] = kind.plural;
    row["size"] = kind.number_of_vertices;
    row["faces"] = faces;
    kinds.append(row);
  }
  return kinds;
}

} // namespace

void add_mesh(py::module_& module)
{
  static_assert(sizeof(Kernel::Point_3) == 3 * sizeof(double), "points are viewed as doubles");
  static_assert(sizeof(mm3::Element_kind) == 1 && sizeof(mm3::Vertex_index) == sizeof(std::uint32_t)
                && sizeof(std::size_t) == sizeof(std::int64_t));
  const auto labels = [](const Mesh& mesh) {
    return of_elements<std::int32_t>(mesh, [&](mm3::Element_index e) {
      return std::int32_t(mesh.subdomain_index(e));
    });
  };
  const auto in_region = [](const Mesh& mesh) {
    return of_elements<bool>(mesh, [&](mm3::Element_index e) { return mesh.attributes(e).is_in_region; });
  };
  const auto copy = [](const Mesh& mesh) { return std::make_shared<Mesh>(mesh); };
  py::class_<Mesh, std::shared_ptr<Mesh>>(
    module, "Mesh",
    "A mesh of tetrahedra, pyramids, prisms and hexahedra. Its arrays look into it, and cannot be written.")
    .def(py::init(&mesh_of_arrays), py::arg("points"), py::arg("kinds"), py::arg("connectivity"),
         py::arg("labels") = py::none(), py::arg("in_region") = py::none(),
         "Of arrays as those below; labels are 1 and nothing is in the region if that is not told.")
    .def_property_readonly(
      "points",
      [](const py::object& self) {
        const Mesh& mesh = self.cast<const Mesh&>();
        const auto n = py::ssize_t(mesh.number_of_vertices());
        return view_of(reinterpret_cast<const double*>(mesh.points().data()), {n, 3}, self);
      },
      "The vertices, (n, 3), in the unit of the surface.")
    .def_property_readonly("kinds", view_of_elements<std::uint8_t>([
                           ](const mm3::Element_list& e) -> const auto& { return e.kinds(); }),
                           "The kind of each element: its place in KINDS.")
    .def_property_readonly("connectivity", view_of_elements<std::uint32_t>([
                           ](const mm3::Element_list& e) -> const auto& { return e.connectivity(); }),
                           "The vertices of all elements, one element after the other.")
    .def_property_readonly(
      "offsets",
      view_of_elements<std::int64_t>([](const mm3::Element_list& e) -> const auto& { return e.offsets(); }),
      "Where each element begins in the connectivity, and its end: one more than elements.")
    .def_property_readonly("labels", labels, "The subdomain of each element.")
    .def_property_readonly("in_region", in_region, "Whether each element meets the region of interest.")
    .def("__copy__", copy)
    .def("__deepcopy__", [copy](const Mesh& mesh, const py::dict&) { return copy(mesh); })
    .def(py::pickle(
      [labels, in_region](const py::object& self) {
        const auto& mesh = self.cast<const Mesh&>();
        return py::make_tuple(self.attr("points"), self.attr("kinds"),
                              self.attr("connectivity").attr("astype")("int64"),
                              labels(mesh).attr("astype")("int64"), in_region(mesh));
      },
      [](const py::tuple& state) {
        return mesh_of_arrays(state[0].cast<Doubles>(), state[1].cast<Kinds>(), state[2].cast<Integers>(),
                              state[3].cast<Integers>(), state[4].cast<Marks>());
      }));
  module.def("certify", &certify);
  module.def("defects", &defects);
  module.def("quality", &quality);
  module.def("save", &save);
  module.def("element_kinds", &element_kinds);
  module.attr("CGAL_version") = CGAL_VERSION_STR;
}
