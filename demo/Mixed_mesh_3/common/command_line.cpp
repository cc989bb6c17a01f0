// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/command_line.h"

#include <cmath>

CLI::Validator number(const std::string& wanted, const std::function<bool(double)>& is_valid)
{
  return CLI::Validator(
    [=](const std::string& text) {
      double x;
      return CLI::detail::lexical_cast(text, x) && is_valid(x) && std::isfinite(x)
               ? std::string()
               : "expected a number " + wanted + ", not " + text;
    },
    "");
}

std::optional<int> parse(CLI::App& app, int argc, char** argv, const std::function<void()>& check)
{
  try {
    app.parse(argc, argv);
    check();
    return std::nullopt;
  } catch(const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
}
