// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers in messages of the programs: with a unit, and without a power of ten.

#include "core/messages.h"

#include <boost/core/lightweight_test.hpp>

namespace test_messages {

int run(int, char*[])
{
  BOOST_TEST_EQ(duration(0.0081), "8.1 ms");
  BOOST_TEST_EQ(duration(0.9994), "999 ms");
  BOOST_TEST_EQ(duration(0.9999), "1 s");
  BOOST_TEST_EQ(duration(95.49), "95.5 s");
  BOOST_TEST_EQ(duration(1200), "20 min");
  for(double seconds = 1e-4; seconds < 5e4; seconds *= 1.01)
    BOOST_TEST_EQ(duration(seconds).find('e'), std::string::npos);

  BOOST_TEST_EQ(as_part_of(1), "100 % of");
  BOOST_TEST_EQ(as_part_of(0.99812), "99.8 % of");
  BOOST_TEST_EQ(as_part_of(12.34), "12.3 times");

  BOOST_TEST_EQ(volume_with_unit(0.0035, true), "0.0035 mm^3");
  BOOST_TEST_EQ(volume_with_unit(1.5e6, true), "1500 ml");
  BOOST_TEST_EQ(volume_with_unit(1234, false), "1234 cubic units");
  return boost::report_errors();
}

} // namespace test_messages
