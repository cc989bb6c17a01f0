// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/messages.h"

#include <iomanip>
#include <sstream>

std::string rounded(double x)
{
  std::ostringstream text;
  text << std::setprecision(3) << x;
  return text.str();
}

std::string counted(std::size_t n, const char* one, const char* many)
{
  return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

std::string place(const std::array<double, 3>& p)
{
  std::ostringstream text;
  text << '(' << p[0] << ", " << p[1] << ", " << p[2] << ')';
  return text.str();
}
