// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "page/page.h"

#include "page/page_files.h"

#include <CGAL/Mixed_mesh_3/quality.h>

#include <CGAL/Bbox_3.h>

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string_view>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// Numbers one after the other, little-endian, as base64: the page makes typed arrays of them.
class Packed_array
{
  std::string m_text;
  std::uint32_t m_bits = 0;
  int m_number_of_bytes = 0; // bytes in `m_bits`

  // Appends the six bits of each character, the first bits the highest.
  void put_characters(int count)
  {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for(int i = 0; i < count; ++i)
      m_text += digits[(m_bits >> (18 - 6 * i)) & 63];
  }

public:
  void add(std::uint8_t byte)
  {
    m_bits |= std::uint32_t(byte) << (16 - 8 * m_number_of_bytes);
    if(++m_number_of_bytes < 3)
      return;
    put_characters(4);
    m_bits = 0;
    m_number_of_bytes = 0;
  }

  void add(std::uint32_t word)
  {
    for(int shift = 0; shift < 32; shift += 8)
      add(std::uint8_t(word >> shift));
  }

  void add(double x)
  {
    const float value = float(x);
    std::uint32_t word;
    static_assert(sizeof word == sizeof value);
    std::memcpy(&word, &value, sizeof word);
    add(word);
  }

  std::string text()
  {
    if(m_number_of_bytes > 0) {
      put_characters(m_number_of_bytes + 1);
      m_text.append(std::size_t(3 - m_number_of_bytes), '=');
      m_number_of_bytes = 0;
    }
    return m_text;
  }
};

// The table of element kinds, by which the page finds the faces to draw.
Json describe_kinds()
{
  Json kinds = Json::array();
  for(const mm3::Reference_element& kind : mm3::reference_elements) {
    Json faces = Json::array();
    for(int f = 0; f < kind.number_of_faces; ++f) {
      const mm3::Element_face& face = kind.faces[f];
      faces.push_back(std::vector<int>(face.vertices, face.vertices + face.size));
    }
    kinds.push_back(
      {{"name", kind.name}, {"plural", kind.plural}, {"size", kind.number_of_vertices}, {"faces", faces}});
  }
  return kinds;
}

// Adds points relative to the middle of the mesh, where the rounding errors of single precision are smaller.
void describe_points(const Mesh& mesh, Json& result)
{
  CGAL::Bbox_3 box;
  for(const auto& p : mesh.points())
    box += p.bbox();
  const double center[] = {(box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2,
                           (box.zmin() + box.zmax()) / 2};
  Packed_array points;
  for(const auto& p : mesh.points())
    for(int i = 0; i < 3; ++i)
      points.add(p[i] - center[i]);
  result["center"] = center;
  result["points"] = points.text();
}

void describe_elements(const Mesh& mesh, Json& result)
{
  Packed_array kinds, vertices, labels, in_region, ratios;
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    const auto element = mesh.element(e);
    kinds.add(std::uint8_t(element.kind()));
    for(const mm3::Vertex_index v : element)
      vertices.add(std::uint32_t(v));
    labels.add(std::uint32_t(mesh.subdomain_index(e)));
    in_region.add(std::uint8_t(mesh.is_in_region(e)));
    ratios.add(mm3::aspect_ratio_coefficient(mesh, e));
  }
  result["element kinds"] = kinds.text();
  result["element vertices"] = vertices.text();
  result["labels"] = labels.text();
  result["in region"] = in_region.text();
  result["ARC"] = ratios.text();
}

Json describe(const Page_data::Step& step)
{
  Packed_array displacements, is_removed;
  for(const double x : step.displacements)
    displacements.add(x);
  for(const bool b : step.is_removed)
    is_removed.add(std::uint8_t(b));
  return {{"name", step.name}, {"displacements", displacements.text()}, {"removed", is_removed.text()}};
}

// Replaces each path in a text by the name of the file.
std::string without_folders(std::string text, const std::vector<std::string>& paths)
{
  for(const std::string& path : paths) {
    const std::string quoted = boost::algorithm::replace_all_copy(path, "'", "'\\''"); // in a command
    for(const std::string& p : {path, quoted})
      boost::algorithm::replace_all(text, p, p.substr(p.rfind('/') + 1));
  }
  return text;
}

// Replaces paths in all texts.
void remove_folders(Json& json, const std::vector<std::string>& paths)
{
  if(json.is_string())
    json = without_folders(json.get<std::string>(), paths);
  else if(json.is_structured())
    for(Json& part : json)
      remove_folders(part, paths);
}

// The files that are in folders, longest path first, as one path may begin another.
std::vector<std::string> in_folders(std::vector<std::string> paths)
{
  paths.erase(std::remove_if(paths.begin(), paths.end(),
                             [](const std::string& path) { return path.find('/') == std::string::npos; }),
              paths.end());
  std::stable_sort(paths.begin(), paths.end(),
                   [](const std::string& p, const std::string& q) { return p.size() > q.size(); });
  return paths;
}

Json describe(const Mesh& mesh, const Page_data& data, Json report)
{
  const std::vector<std::string> paths = in_folders(data.files);
  remove_folders(report, paths);
  for(const char* measured : {"stages", "seconds", "ms", "peak memory MiB"})
    report.erase(measured);
  Json result = {{"command", without_folders(data.command, paths)},
                 {"is in patient space", data.is_in_patient_space},
                 {"report", std::move(report)},
                 {"kinds", describe_kinds()}};
  result["subdomain names"] = Json::array();
  for(const auto& [index, name] : data.subdomain_names)
    result["subdomain names"].push_back({index, name});
  describe_points(mesh, result);
  describe_elements(mesh, result);
  result["steps"] = Json::array();
  for(const Page_data::Step& step : data.steps)
    result["steps"].push_back(describe(step));
  return result;
}

// The text of a script element, which no part of the text can end: in JSON, `<` is in strings only.
std::string in_script(const Json& json)
{
  std::string text;
  for(const char c : text_of(json, -1))
    if(c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

} // namespace

std::string page(const Mesh& mesh, const Page_data& data, Json report)
{
  const std::string json = in_script(describe(mesh, data, std::move(report)));
  std::string text;
  std::string_view rest = page_files[0].text;
  for(std::size_t begin; (begin = rest.find("{{")) != std::string_view::npos;) {
    const std::size_t end = rest.find("}}", begin);
    const std::string_view name = rest.substr(begin + 2, end - begin - 2);
    const auto file = std::find_if(std::begin(page_files), std::end(page_files),
                                   [&](const Page_file& f) { return f.name == name; });
    text.append(rest.substr(0, begin)).append(file != std::end(page_files) ? file->text : json);
    rest.remove_prefix(end + 2);
  }
  return text.append(rest);
}
