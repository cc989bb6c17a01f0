// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names of the labels of an image, from a file.

#ifndef MIXED_MESH_3_APPS_CORE_LABEL_TABLE_H
#define MIXED_MESH_3_APPS_CORE_LABEL_TABLE_H

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// A number of a label, if a text is a whole number from 0 to 4,294,967,295.
std::optional<std::uint32_t> label_number(const std::string& text);

/// The names of labels; by default there are none.
class Label_table
{
  std::string m_path;
  std::map<std::uint32_t, std::string> m_names; // by number

public:
  Label_table() = default;
  /// Reads a color table of FreeSurfer or 3D Slicer, or the file of labels of ITK-SNAP.
  /// \throw std::runtime_error a line naming the file, its line and the defect
  explicit Label_table(const std::string& path);

  const std::string& path() const { return m_path; } ///< empty if there is no file
  /// The name of a label; empty if the table does not have the label.
  std::string name(std::uint32_t label) const;
  /// The labels with a name, in upper or lower case, ascending: several ones may have the same.
  std::vector<std::uint32_t> labels(const std::string& name) const;
  /// The names that are most like one that the table does not have, in words.
  std::string closest_in_words(const std::string& name) const;
};

#endif // MIXED_MESH_3_APPS_CORE_LABEL_TABLE_H
