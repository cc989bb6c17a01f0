// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/messages.h"

#include <cmath>
#include <cstdio>
#include <iomanip>
#include <sstream>

std::string printable(const std::string& text)
{
  std::string result;
  for(std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = [&](std::size_t j) { return j < text.size() ? (unsigned char)(text[j]) : 0; };
    const bool is_second_set = byte(i) == 0xc2 && byte(i + 1) >= 0x80 && byte(i + 1) < 0xa0; // in UTF-8
    if(byte(i) >= ' ' && byte(i) != 0x7f && !is_second_set) {
      result += text[i];
      continue;
    }
    i += is_second_set;
    char code[8];
    std::snprintf(code, sizeof(code), "\\x%02x", unsigned(byte(i)));
    result += code;
  }
  return result;
}

std::string rounded(double x)
{
  std::ostringstream text;
  text << std::setprecision(3) << x;
  return text.str();
}

std::string percent(double share) { return rounded(std::round(1000 * share) / 10) + " %"; }

std::string as_part_of(double ratio)
{
  return ratio < 2 ? percent(ratio) + " of" : rounded(ratio) + " times";
}

std::string duration(double seconds)
{
  if(seconds < 0.9995) // else three digits would be a second
    return rounded(1000 * seconds) + " ms";
  return seconds < 300 ? rounded(seconds) + " s" : rounded(seconds / 60) + " min";
}

std::string volume_with_unit(double volume, bool is_in_mm)
{
  constexpr double ml = 1000;         // in mm^3
  const auto in_full = [](double x) { // no power of ten for organs in mm
    return x >= 1000 && x < 1e9 ? std::to_string(std::llround(x)) : rounded(x);
  };
  if(!is_in_mm)
    return in_full(volume) + " cubic units";
  return volume < ml ? rounded(volume) + " mm^3" : in_full(volume / ml) + " ml";
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
