// SPDX-License-Identifier: GPL-3.0-or-later
/// \file facet_tree.hpp  Defines one name for CGAL's AABB tree over the facets of a mesh, in CGAL 5 and CGAL 6.
#pragma once

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#if __has_include(<CGAL/AABB_traits_3.h>)
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif

namespace macadam {

#if __has_include(<CGAL/AABB_traits_3.h>)
template <class Kernel, class Mesh>
using FacetTree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;
#else
template <class Kernel, class Mesh>
using FacetTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;
#endif

}  // namespace macadam
