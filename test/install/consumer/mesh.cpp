// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Simple_cartesian.h>

#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

// One hexahedron: enough to see that headers, CGAL, its number types and the language standard are found.
int main()
{
  CGAL::Mixed_mesh_3<CGAL::Simple_cartesian<double>> mesh;
  std::vector<mm3::Vertex_index> vertices;
  for(int i = 0; i < 8; ++i)
    vertices.push_back(mesh.add_vertex({double((i + 1) / 2 % 2), double(i / 2 % 2), double(i / 4)}));
  mesh.add_element(mm3::HEXAHEDRON, vertices);
  return mm3::jacobian_sign(mesh, 0) == mm3::Jacobian_sign::POSITIVE ? 0 : 1;
}
