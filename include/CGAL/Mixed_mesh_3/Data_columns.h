// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_DATA_COLUMNS_H
#define CGAL_MIXED_MESH_3_DATA_COLUMNS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Mesh
/// A row that a new row comes from.
struct Weighted_row
{
  std::size_t row; ///< vertex
  double weight;   ///< share of the row; the shares of a new row sum up to 1
};

/*!
\ingroup PkgMixedMesh3Mesh

\brief Numbers of the user at each vertex, or each element, of a mesh: a named column of `Data_columns`.

A row, that of a vertex or an element, has one or several numbers, such as a temperature, or the three
components of a direction. Their unit is the user's.
*/
class Data_column
{
public:
  /// The type of a rule: a function that computes the row of a new vertex.
  /// It receives the column, the old rows that the new one comes from, and room for `number_of_components()`
  /// numbers, which it fills.
  using Rule = std::function<void(const Data_column&, const std::vector<Weighted_row>&, double*)>;

private:
  std::string m_name;
  std::vector<double> m_values;
  int m_number_of_components;
  Rule m_rule = weighted_mean;

  friend class Data_columns;

  Data_column(std::string name, std::vector<double> values, int number_of_components)
    : m_name(std::move(name)), m_values(std::move(values)), m_number_of_components(number_of_components)
  {
    CGAL_precondition(number_of_components > 0 && m_values.size() % components() == 0);
  }

  std::size_t components() const { return std::size_t(m_number_of_components); }

  // The new numbers are computed apart: the column may move when it grows.
  void add_row(const std::vector<Weighted_row>& origins)
  {
    std::vector<double> row(components(), std::numeric_limits<double>::quiet_NaN());
    if(origins.size() == 1)
      std::copy_n((*this)[origins.front().row], components(), row.begin());
    else if(!origins.empty())
      m_rule(*this, origins, row.data());
    m_values.insert(m_values.end(), row.begin(), row.end());
  }

  template <class Rows>
  Data_column selected(const Rows& rows) const
  {
    Data_column result(m_name, {}, m_number_of_components);
    result.m_rule = m_rule;
    result.m_values.reserve(std::size(rows) * components());
    for(std::size_t row : rows)
      result.m_values.insert(result.m_values.end(), (*this)[row], (*this)[row] + components());
    return result;
  }

public:
  /// The name.
  const std::string& name() const { return m_name; }
  /// The number of numbers in a row.
  int number_of_components() const { return m_number_of_components; }
  /// The number of rows.
  std::size_t number_of_rows() const { return m_values.size() / components(); }
  /// All numbers: those of the first row, and so on.
  const std::vector<double>& values() const { return m_values; }

  /// The numbers of a row. \pre `row < number_of_rows()`
  const double* operator[](std::size_t row) const
  {
    CGAL_precondition(row < number_of_rows());
    return m_values.data() + row * components();
  }
  /// The numbers of a row, to be changed. \pre `row < number_of_rows()`
  double* operator[](std::size_t row)
  {
    CGAL_precondition(row < number_of_rows());
    return m_values.data() + row * components();
  }

  /// Sets the rule of new vertices, `weighted_mean()` by default.
  void set_rule(Rule rule)
  {
    CGAL_precondition(rule != nullptr);
    m_rule = std::move(rule);
  }

  /// The rule by default: the weighted mean of the rows, component by component.
  static void weighted_mean(const Data_column& column, const std::vector<Weighted_row>& origins, double* row)
  {
    for(int i = 0; i < column.number_of_components(); ++i) {
      row[i] = 0;
      for(const Weighted_row& origin : origins)
        row[i] += origin.weight * column[origin.row][i];
    }
  }
};

/*!
\ingroup PkgMixedMesh3Mesh

\brief The data of the user at the vertices, or at the elements, of a `Mixed_mesh_3`: named columns, each with
a row for each of them.

All functions that change a mesh, or make a mesh of one, pass the data on:
- a vertex or an element that stays, or is copied, keeps its row to the bit, also if it moves;
- a vertex in the middle of a bisected edge has the mean of the rows of both ends, each of weight 1/2, unless
  the column has another rule (`Data_column::set_rule()`). If an end is such a vertex itself, its row is
  computed first;
- an element that replaces others has the row of the old element that contains its center, of those of the
  same subdomain. Vertices are then taken where they were in the old mesh, and the middle of an edge in its
  middle: data go with the material when vertices move. If no element contains the center, the nearest one
  counts.

A row that is added without an origin (`Mixed_mesh_3::add_vertex()`, `Mixed_mesh_3::add_element()`) is NaN,
which cannot be mistaken for a value. `Mixed_mesh_3::assign()`, if no data are given, and
`Mixed_mesh_3::clear()` remove all columns.

Data take no time if there are no columns, and have no effect on vertices and elements.
*/
class Data_columns
{
  std::vector<Data_column> m_columns;

public:
  /// \name Columns
  /// @{

  /// Adds a column, behind the others. Pointers to columns become invalid.
  /// \param name name. \pre no column has it, and it is not empty
  /// \param values numbers of the first row, and so on. \pre a row for each vertex, or each element
  /// \param number_of_components number of numbers in a row. \pre positive
  /// \return the column
  Data_column& add(std::string name, std::vector<double> values, int number_of_components = 1)
  {
    CGAL_precondition(!name.empty() && find(name) == nullptr);
    Data_column column(std::move(name), std::move(values), number_of_components);
    CGAL_precondition(m_columns.empty() || column.number_of_rows() == m_columns[0].number_of_rows());
    m_columns.push_back(std::move(column));
    return m_columns.back();
  }

  /// Removes a column, if there is one of the name. \return whether there was
  bool remove(const std::string& name)
  {
    const auto found = std::find_if(m_columns.begin(), m_columns.end(),
                                    [&](const Data_column& c) { return c.name() == name; });
    if(found == m_columns.end())
      return false;
    m_columns.erase(found);
    return true;
  }

  /// The column of a name; null if there is none.
  const Data_column* find(const std::string& name) const
  {
    const auto found = std::find_if(m_columns.begin(), m_columns.end(),
                                    [&](const Data_column& c) { return c.name() == name; });
    return found == m_columns.end() ? nullptr : &*found;
  }
  /// The column of a name, to be changed; null if there is none.
  Data_column* find(const std::string& name)
  {
    return const_cast<Data_column*>(std::as_const(*this).find(name));
  }

  /// The number of columns.
  std::size_t size() const { return m_columns.size(); }
  /// Whether there is no column.
  bool empty() const { return m_columns.empty(); }
  /// The first column, in the order in which they were added.
  std::vector<Data_column>::const_iterator begin() const { return m_columns.begin(); }
  /// The end of the columns.
  std::vector<Data_column>::const_iterator end() const { return m_columns.end(); }

  /// Whether each column has `n` rows.
  bool has_size(std::size_t n) const
  {
    return std::all_of(m_columns.begin(), m_columns.end(),
                       [n](const Data_column& c) { return c.number_of_rows() == n; });
  }
  /// @}

  /// \name Rows
  /// Functions for those who write operations on meshes of their own.
  /// @{

  /// Adds a row to each column: a copy of the row it comes from; of several ones, what the column's rule
  /// makes of them; without one, NaN.
  /// \pre the weights sum up to 1, not checked
  void add_row(const std::vector<Weighted_row>& origins)
  {
    for(Data_column& column : m_columns)
      column.add_row(origins);
  }

  /// Adds a row of NaN to each column.
  void add_row()
  {
    if(!m_columns.empty())
      add_row({});
  }

  /// The columns with these rows only, in this order; rows may occur several times.
  /// \tparam Rows a range of numbers, for example of `Vertex_index`
  template <class Rows>
  Data_columns selected(const Rows& rows) const
  {
    Data_columns result;
    for(const Data_column& column : m_columns)
      result.m_columns.push_back(column.selected(rows));
    return result;
  }
  /// @}
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_DATA_COLUMNS_H
