// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files of this folder that pages are made of, as CMake puts them into the program (page_files.cpp.in).

#ifndef MIXED_MESH_3_APPS_PAGE_PAGE_FILES_H
#define MIXED_MESH_3_APPS_PAGE_PAGE_FILES_H

#include <string_view>

struct Page_file
{
  std::string_view name, text;
};

inline constexpr int number_of_page_files = 6;

/// The files; the first one is the template: {{page.css}} marks the place of that file, {{data}} the place of
/// mesh and report.
extern const Page_file page_files[number_of_page_files];

#endif // MIXED_MESH_3_APPS_PAGE_PAGE_FILES_H
