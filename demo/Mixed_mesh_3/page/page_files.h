// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files of this folder that pages are made of, as CMake puts them into the program (page_files.cpp.in).

#ifndef MIXED_MESH_3_DEMO_PAGE_PAGE_FILES_H
#define MIXED_MESH_3_DEMO_PAGE_PAGE_FILES_H

namespace page_files {

extern const char html[];    // page.html
extern const char css[];     // page.css
extern const char library[]; // three.js
extern const char script[];  // page.js

} // namespace page_files

#endif // MIXED_MESH_3_DEMO_PAGE_PAGE_FILES_H
