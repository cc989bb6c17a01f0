// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh as arrays, its certificate and its quality.

#include "arrays.h"

#include <CGAL/Mixed_mesh_3/IO/interface_sets.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/certify_mesh.h>
#include <CGAL/Mixed_mesh_3/extract_subdomains.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <CGAL/version.h>

#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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
    throw std::invalid_argument("kinds, connectivity: expected arrays of one dimension; or cells of shape "
                                "(n, 4) or (n, 8), and labels=");
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

// Names of the kinds of elements in meshio, in the order of `Element_kind`.
constexpr std::array<const char*, mm3::number_of_element_kinds> kind_names = {"tetra", "pyramid", "wedge",
                                                                              "hexahedron"};

mm3::Element_kind kind_named(const std::string& name)
{
  for(const mm3::Element_kind kind : mm3::element_kinds)
    if(name == kind_names[std::size_t(kind)])
      return kind;
  throw std::invalid_argument("cells: there are no elements of the kind '" + name
                              + "'; expected tetra, pyramid, wedge or hexahedron");
}

mm3::Element_kind kind_of_size(py::ssize_t number_of_vertices)
{
  for(const mm3::Element_kind kind : mm3::element_kinds)
    if(mm3::reference_elements[kind].number_of_vertices == number_of_vertices)
      return kind;
  throw std::invalid_argument("cells: expected shape (n, 4), (n, 5), (n, 6) or (n, 8)");
}

// A mesh of elements of one kind, (n, 4), (n, 5), (n, 6) or (n, 8) vertices, or of a dictionary of kinds.
std::shared_ptr<Mesh> mesh_of_cells(const Doubles& points, const py::object& cells,
                                    const std::optional<Integers>& labels,
                                    const std::optional<Marks>& in_region)
{
  std::vector<std::uint8_t> kinds;
  std::vector<std::int64_t> connectivity;
  const auto add = [&](std::optional<mm3::Element_kind> kind, const py::handle& vertices) {
    const auto array = vertices.cast<Integers>();
    if(array.ndim() != 2)
      throw std::invalid_argument("cells: expected integers of shape (n, 4), (n, 5), (n, 6) or (n, 8)");
    if(!kind)
      kind = kind_of_size(array.shape(1));
    if(array.shape(1) != mm3::reference_elements[*kind].number_of_vertices)
      throw std::invalid_argument(std::string("cells: a ") + kind_names[std::size_t(*kind)]
                                  + " does not have " + std::to_string(array.shape(1)) + " vertices");
    kinds.insert(kinds.end(), std::size_t(array.shape(0)), std::uint8_t(*kind));
    connectivity.insert(connectivity.end(), array.data(), array.data() + array.size());
  };
  if(py::isinstance<py::dict>(cells))
    for(const auto& [name, vertices] : cells.cast<py::dict>())
      add(kind_named(name.cast<std::string>()), vertices);
  else
    add(std::nullopt, cells);
  return mesh_of_arrays(points, Kinds(py::ssize_t(kinds.size()), kinds.data()),
                        Integers(py::ssize_t(connectivity.size()), connectivity.data()), labels, in_region);
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

std::shared_ptr<Mesh> extract(const Mesh& mesh, const std::vector<mm3::Subdomain_index>& subdomains)
{
  const py::gil_scoped_release release;
  return std::make_shared<Mesh>(mm3::extract_subdomains(mesh, subdomains));
}

// Values of vertices or elements by name, (n) or (n, components), which have to outlive the result.
std::vector<mm3::IO::Data_array> data_arrays(const std::map<std::string, Doubles>& data,
                                             std::deque<std::vector<double>>& values)
{
  std::vector<mm3::IO::Data_array> arrays;
  for(const auto& [name, array] : data) {
    if(array.ndim() != 1 && array.ndim() != 2)
      throw std::invalid_argument("data \"" + name + "\": expected shape (n) or (n, components)");
    values.emplace_back(array.data(), array.data() + array.size());
    arrays.push_back({name, &values.back(), array.ndim() == 1 ? 1 : int(array.shape(1))});
  }
  return arrays;
}

// Facet sets of boundary faces that are marked.
std::vector<mm3::IO::Facet_set> facet_sets(const Mesh& mesh,
                                           const std::vector<std::pair<std::string, Marks>>& patches)
{
  std::vector<mm3::IO::Facet_set> sets;
  if(patches.empty())
    return sets;
  const std::vector<mm3::Face> boundary = mm3::boundary_faces(mesh);
  for(const auto& [name, faces] : patches) {
    const std::vector<bool> marks = marks_of(faces, boundary.size(), "patch " + name);
    sets.push_back({name, {}});
    for(std::size_t i = 0; i < boundary.size(); ++i)
      if(marks[i])
        sets.back().faces.push_back(boundary[i]);
    if(sets.back().faces.empty())
      throw std::invalid_argument("patch " + name + ": has no face");
  }
  return sets;
}

void save(const Mesh& mesh, const std::string& path, int order, bool has_only_tetrahedra,
          const mm3::IO::Subdomain_names& names, const std::map<std::string, Doubles>& point_data,
          const std::map<std::string, Doubles>& cell_data,
          const std::vector<std::pair<std::string, Marks>>& patches, bool has_interfaces)
{
  mm3::IO::Write_options options;
  options.order = order;
  options.tetrahedra = has_only_tetrahedra;
  options.subdomain_names = names;
  std::deque<std::vector<double>> values;
  options.vertex_data = data_arrays(point_data, values);
  options.element_data = data_arrays(cell_data, values);
  if(has_interfaces)
    options.facet_sets = mm3::IO::interface_sets(mesh, names);
  if(options.facet_sets.size() == 1) // the boundary of one subdomain
    options.facet_sets.clear();
  for(mm3::IO::Facet_set& set : facet_sets(mesh, patches))
    options.facet_sets.push_back(std::move(set));
  std::string error;
  bool is_written;
  {
    const py::gil_scoped_release release;
    is_written = mm3::IO::write_mixed_mesh(path, mesh, options, &error);
  }
  if(!is_written)
    throw std::invalid_argument(error);
}

// A mesh from a file, and the names of its subdomains.
std::pair<std::shared_ptr<Mesh>, mm3::IO::Subdomain_names> read_mesh(const std::string& path)
{
  auto mesh = std::make_shared<Mesh>();
  mm3::IO::Subdomain_names names;
  std::string error;
  bool is_read;
  {
    const py::gil_scoped_release release;
    is_read = mm3::IO::read_mixed_mesh(path, *mesh, names, &error);
  }
  if(!is_read)
    throw std::invalid_argument(error);
  return {mesh, names};
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
  const auto copy = [](const py::object& self) {
    const py::object result = py::cast(std::make_shared<Mesh>(self.cast<const Mesh&>()));
    result.attr("__dict__").attr("update")(self.attr("__dict__"));
    return result;
  };
  py::class_<Mesh, std::shared_ptr<Mesh>>(
    module, "Mesh", py::dynamic_attr(),
    "A mesh of tetrahedra, pyramids, prisms and hexahedra. Its arrays look into it, and cannot be "
    "written.\n\n"
    "Mesh(points, cells, labels=, in_region=): cells are vertices of elements of one kind, of shape (n, 4), "
    "(n, 5), (n, 6) or (n, 8), or a dictionary as the property `cells` has it. Mesh(points, kinds, "
    "connectivity, labels, in_region): arrays as the properties have them. Labels are 1, and nothing is in "
    "the "
    "region, if that is not told. names: {label: name} of subdomains, which save() writes.")
    .def(py::init(&mesh_of_arrays), py::arg("points"), py::arg("kinds"), py::arg("connectivity"),
         py::arg("labels") = py::none(), py::arg("in_region") = py::none(),
         "Arrays as the properties have them.")
    .def(py::init(&mesh_of_cells), py::arg("points"), py::arg("cells"), py::kw_only(),
         py::arg("labels") = py::none(), py::arg("in_region") = py::none(),
         "Elements of one kind, or a dictionary of kinds.")
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
    .def("__deepcopy__", [copy](const py::object& self, const py::dict&) { return copy(self); })
    .def(py::pickle(
      [labels, in_region](const py::object& self) {
        const auto& mesh = self.cast<const Mesh&>();
        return py::make_tuple(self.attr("points"), self.attr("kinds"),
                              self.attr("connectivity").attr("astype")("int64"),
                              labels(mesh).attr("astype")("int64"), in_region(mesh), self.attr("__dict__"));
      },
      [](const py::tuple& state) {
        return std::make_pair(mesh_of_arrays(state[0].cast<Doubles>(), state[1].cast<Kinds>(),
                                             state[2].cast<Integers>(), state[3].cast<Integers>(),
                                             state[4].cast<Marks>()),
                              state[5].cast<py::dict>());
      }));
  module.def("certify", &certify);
  module.def("defects", &defects);
  module.def("quality", &quality);
  module.def("extract", &extract);
  module.def("save", &save);
  module.def("read_mesh", &read_mesh);
  module.def("element_kinds", &element_kinds);
  module.attr("KINDS") = py::tuple(py::cast(kind_names));
  module.attr("CGAL_version") = CGAL_VERSION_STR;
}
