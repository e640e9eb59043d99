#pragma once
// Curves as triangles: tubes of a polygonal section, or ribbons.

#include <glm/glm.hpp>
#include <vector>

namespace kaustik::pbrt {

// One cubic Bezier curve.
struct CurveSegment {
  glm::dvec3 P[4];
  double width0 = 1, width1 = 1;
  // Of a ribbon, at both ends; zero for tubes.
  glm::vec3 n0{0}, n1{0};
  bool continues = false;  // begins where the segment before it in the list ends
};

// How finely tubes follow their curves.
struct TubeDetail {
  int sides = 12;
  double tolerance = 0.1;  // distance from the curve, as a share of its width
  int most_steps = 64;     // along one segment
};

// Triangles in the form of the parameters of a "trianglemesh".
struct TubeMesh {
  std::vector<double> P, N, indices;
};

// The section of a tube has the circumference of the circle whose diameter is the width, so that the area and
// the mean width from all directions are those of the round tube; normals are those of the round tube, too.
// Tubes have no caps.
TubeMesh tubes_of(const std::vector<CurveSegment>& segments, const TubeDetail& detail);

}  // namespace kaustik::pbrt
