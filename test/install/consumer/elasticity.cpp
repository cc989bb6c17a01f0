// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Simple_cartesian.h>

#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

// A tetrahedron that is fixed at three vertices hangs down at the fourth.
int main()
{
  CGAL::Mixed_mesh_3<CGAL::Simple_cartesian<double>> mesh;
  std::vector<mm3::Vertex_index> vertices;
  for(int i = 0; i < 4; ++i)
    vertices.push_back(mesh.add_vertex({double(i == 1), double(i == 2), double(i == 3)}));
  mesh.add_element(mm3::TETRAHEDRON, vertices);

  CGAL::Linear_elasticity_3 model(mesh);
  for(int i = 0; i < 3; ++i)
    model.prescribe(vertices[i]);
  model.set_gravity({0, 0, -9810});
  const auto success = CGAL::Linear_elasticity_status::SUCCESS;
  const bool is_solved = model.factor().status == success && model.solve().status == success;
  return is_solved && model.displacements()[3][2] < 0 ? 0 : 1;
}
