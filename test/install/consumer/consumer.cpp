// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>

// One hexahedron: enough to see that headers, CGAL and the language standard are found.
int main()
{
  CGAL::Mixed_mesh_3<CGAL::Simple_cartesian<double>> mesh;
  for(int i = 0; i < 8; ++i)
    mesh.add_vertex({double((i + 1) / 2 % 2), double(i / 2 % 2), double(i / 4)});
  mesh.add_element(CGAL::Mixed_meshes_3::HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7});
  return std::abs(CGAL::Mixed_meshes_3::volume(mesh) - 1) < 1e-12 ? 0 : 1;
}
