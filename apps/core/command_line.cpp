// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/command_line.h"

#include "core/messages.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace {

// A word without blanks around a number, which may be the value of an option or stand alone.
std::string with_numbers_trimmed(const std::string& word)
{
  const char* const blanks = " \t\n\r";
  const std::size_t equal = word.substr(0, 2) == "--" ? word.find('=') : std::string::npos;
  const std::size_t start = equal == std::string::npos ? 0 : equal + 1;
  const std::size_t first = word.find_first_not_of(blanks, start);
  if(first == std::string::npos)
    return word;
  const std::string trimmed = word.substr(first, word.find_last_not_of(blanks) + 1 - first);
  double x;
  return CLI::detail::lexical_cast(trimmed, x) ? word.substr(0, start) + trimmed : word;
}

} // namespace

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

CLI::Validator poisson_ratio()
{
  return number("of at least 0 and at most 0.499999", [](double x) { return x >= 0 && x <= 0.499999; });
}

CLI::Validator count(std::size_t largest)
{
  return CLI::Validator(
    [=](const std::string& text) {
      std::size_t n = 0;
      const char* const end = text.data() + text.size();
      const std::from_chars_result result = std::from_chars(text.data(), end, n);
      return result.ec == std::errc() && result.ptr == end && n >= 1 && n <= largest
               ? std::string()
               : "expected a whole number from 1 to " + std::to_string(largest) + ", not " + text;
    },
    "");
}

void add_surface_options(CLI::App& app, CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options& options)
{
  using Space = CGAL::Mixed_meshes_3::IO::Anatomical_space;
  app
    .add_option_function<std::string>(
      "--space",
      [&options](const std::string& name) { options.space = name == "LPS" ? Space::LPS : Space::RAS; },
      "Space of the coordinates in surface files; in LPS, x and y are negated (default: what a file says, or "
      "RAS)")
    ->check(CLI::IsMember({"RAS", "LPS"}))
    ->type_name("SPACE");
  CLI::Option* const strict = app.add_flag(
    "--strict", options.is_strict,
    "Refuse surfaces that have holes, cut themselves or are no manifold, instead of repairing them");
  app
    .add_option(
      "--wrap", options.wrap_diameter,
      "Wrap surfaces, with defects or without, as in foil: openings narrower than D are closed, details "
      "smaller than D / 30 are lost")
    ->check(number("greater than 0", [](double x) { return x > 0; }))
    ->type_name("D")
    ->excludes(strict);
  app
    .add_option(
      "--weld", options.weld_distance,
      "Where a surface is not closed, points up to D apart are one point: cracks narrower than D are closed "
      "(default: a millionth of the surface's diagonal)")
    ->check(number("greater than 0", [](double x) { return x > 0; }))
    ->type_name("D");
}

std::string command_of(const char* name, int argc, const char* const* argv)
{
  const char* const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  std::string command = name;
  for(int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if(!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      command += ' ' + word;
      continue;
    }
    command += " '";
    for(const char c : word)
      command += c == '\'' ? std::string("'\\''") : std::string(1, c);
    command += '\'';
  }
  return command;
}

std::optional<int> parse(const char* name, CLI::App& app, int argc, char** argv,
                         const std::function<void()>& check)
{
  std::vector<std::string> words;
  for(int i = 0; i < argc; ++i)
    words.push_back(i == 0 ? argv[i] : with_numbers_trimmed(argv[i]));
  std::vector<const char*> pointers;
  for(const std::string& word : words)
    pointers.push_back(word.c_str());
  // Column of the descriptions: there are two blanks before each of them, or a line of its own; else help2man
  // takes it for a part of the option.
  app.get_formatter()->column_width(37);
  try {
    app.parse(argc, pointers.data());
    check();
    return std::nullopt;
  } catch(const CLI::ParseError& e) {
    if(e.get_exit_code() == 0)
      return app.exit(e);
    std::cerr << name << ": error: " << printable(e.what()) << "; see --help\n";
    return 2;
  } catch(const std::runtime_error& e) { // a file with a defect that an option reads
    std::cerr << name << ": error: " << printable(e.what()) << '\n';
    return 1;
  }
}
