#pragma once
// Draws curves on two logarithmic axes as SVG. Values outside 1e-30 to 1e30, including zero, are omitted. Not
// handled: other scales.

#include <string>
#include <vector>

namespace kaustik::app {

struct Sample {
  double x = 0, y = 0;
  double low = 0, high = 0;  // range of y, drawn as a bar if they differ
};

struct Curve {
  std::string name;
  std::vector<Sample> samples;
};

// A dashed line from (x0, y0) to (x1, y1). On logarithmic axes it shows a power law.
struct Guide {
  double x0 = 1, y0 = 1, x1 = 1, y1 = 1;
};

struct Axis {
  std::string label;
  std::vector<double> ticks;  // empty = round numbers in the range of the values
};

struct Chart {
  std::string title;
  std::vector<std::string> subtitles;  // one line each
  Axis x, y;
  std::vector<Curve> curves;  // colours and marks repeat after six
  std::vector<Guide> guides;
  std::string guide_name;  // name of all guides in the legend
};

// The chart as SVG. Texts are UTF-8; characters that XML does not allow are dropped.
std::string draw_svg(const Chart& chart);

}  // namespace kaustik::app
