#include "apps/bench/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "apps/bench/log_axis.h"

namespace kaustik::app {

namespace {

constexpr double kWidth = 760, kHeight = 500;
constexpr double kLeft = 78, kRight = 560, kBottom = 430;  // the plot's frame; the legend is to its right
constexpr double kTitleY = 30, kSubtitleStep = 17, kTickGap = 24;
constexpr double kBarShift = 7;  // offset between the error bars of different curves, so that all are visible

// Colours that colour-blind readers can tell apart (Okabe and Ito 2008).
constexpr std::array<std::string_view, 6> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                      "#cc79a7", "#56b4e9", "#e69f00"};

// Escapes a UTF-8 text for XML 1.0 and drops control characters, which XML does not allow.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      out += c;
  }
  return out;
}

std::string text_at(double x, double y, std::string_view attributes, std::string_view text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}{}>{}</text>\n", x, y, attributes.empty() ? "" : " ",
                     attributes, escaped(text));
}

std::string line_at(double x0, double y0, double x1, double y1, std::string_view attributes) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x0, y0, x1, y1,
                     attributes);
}

// The curve's mark (disc, square, triangle or diamond) in its colour.
std::string mark_at(double x, double y, size_t curve) {
  const std::string_view colour = kColours[curve % kColours.size()];
  constexpr double r = 4.5;
  switch (curve % 4) {
    case 0:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", x, y, r, colour);
    case 1:
      return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"8\" height=\"8\" fill=\"{}\"/>\n", x - 4,
                         y - 4, colour);
    case 2:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l5 9h-10z\" fill=\"{}\"/>\n", x, y - 5.5, colour);
    default:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l5.5 5.5l-5.5 5.5l-5.5 -5.5z\" fill=\"{}\"/>\n", x, y - 5.5,
                         colour);
  }
}

// Values outside this range would overflow the axis arithmetic.
bool drawable(double value) {
  return value > 1e-30 && value < 1e30;
}
bool drawable(double x, double y) {
  return drawable(x) && drawable(y);
}

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = 0;

  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

struct Frame {
  LogAxis x, y;
  double top = 0;
};

Frame make_frame(const Chart& chart) {
  Range x, y;
  const auto add = [&](double px, double py) {
    if (drawable(px, py)) x.add(px), y.add(py);
  };
  for (const Curve& curve : chart.curves)
    for (const Sample& s : curve.samples)
      for (const double value : {s.y, s.low, s.high}) add(s.x, value);
  for (const Guide& g : chart.guides) add(g.x0, g.y0), add(g.x1, g.y1);
  if (x.most == 0) x = y = {1, 2};  // nothing to draw
  const double top = kTitleY + kSubtitleStep * static_cast<double>(chart.subtitles.size()) + 20;
  return {LogAxis(x.least, x.most, kLeft, kRight, chart.x.ticks),
          LogAxis(y.least, y.most, kBottom, top, chart.y.ticks), top};
}

std::string axes_svg(const Chart& chart, const Frame& frame) {
  std::string svg;
  double last = -kTickGap;  // position of the last label; closer ones are omitted
  for (const double tick : frame.x.ticks()) {
    const double x = frame.x.pixel(tick);
    svg += line_at(x, frame.top, x, kBottom, "class=\"grid\"");
    if (x - last < kTickGap) continue;
    last = x;
    svg += text_at(x, kBottom + 19, "text-anchor=\"middle\"", tick_text(tick));
  }
  for (const double tick : frame.y.ticks()) {
    const double y = frame.y.pixel(tick);
    svg += line_at(kLeft, y, kRight, y, "class=\"grid\"");
    svg += text_at(kLeft - 8, y + 4.5, "text-anchor=\"end\"", tick_text(tick));
  }
  svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"frame\"/>\n", kLeft,
                     frame.top, kRight - kLeft, kBottom - frame.top);
  svg += text_at((kLeft + kRight) / 2, kBottom + 46, "text-anchor=\"middle\"", chart.x.label);
  const double middle = (frame.top + kBottom) / 2;
  svg +=
      text_at(22, middle, fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 22 {:.1f})\"", middle),
              chart.y.label);
  return svg;
}

std::string guides_svg(const Chart& chart, const Frame& frame) {
  std::string svg;
  for (const Guide& g : chart.guides) {
    if (!drawable(g.x0, g.y0) || !drawable(g.x1, g.y1)) continue;
    svg += line_at(frame.x.pixel(g.x0), frame.y.pixel(g.y0), frame.x.pixel(g.x1), frame.y.pixel(g.y1),
                   "class=\"guide\"");
  }
  return svg;
}

std::string curve_svg(const Curve& curve, size_t index, double bar_shift, const Frame& frame) {
  const std::string_view colour = kColours[index % kColours.size()];
  std::string bars, marks, points;
  for (const Sample& s : curve.samples) {
    if (!drawable(s.x, s.y)) continue;
    const double x = frame.x.pixel(s.x), y = frame.y.pixel(s.y);
    points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", x, y);
    marks += mark_at(x, y, index);
    if (!(s.low < s.high) || !drawable(s.low, s.high)) continue;
    const double low = frame.y.pixel(s.low), high = frame.y.pixel(s.high);
    const double bar = x + bar_shift;
    const std::string stroke = fmt::format("stroke=\"{}\"", colour);
    bars += line_at(bar, low, bar, high, stroke) + line_at(bar - 3, low, bar + 3, low, stroke) +
            line_at(bar - 3, high, bar + 3, high, stroke);
  }
  return bars +
         fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", points,
                     colour) +
         marks;
}

std::string legend_svg(const Chart& chart, const Frame& frame) {
  constexpr double kStep = 24, kLength = 30, kStart = kRight + 20;
  std::string svg;
  double y = frame.top + 14;
  for (size_t i = 0; i < chart.curves.size(); ++i, y += kStep) {
    svg += line_at(kStart, y, kStart + kLength, y,
                   fmt::format("stroke=\"{}\" stroke-width=\"2\"", kColours[i % kColours.size()]));
    svg += mark_at(kStart + kLength / 2, y, i);
    svg += text_at(kStart + kLength + 8, y + 4.5, "", chart.curves[i].name);
  }
  if (chart.guides.empty()) return svg;
  svg += line_at(kStart, y, kStart + kLength, y, "class=\"guide\"");
  return svg + text_at(kStart + kLength + 8, y + 4.5, "", chart.guide_name);
}

constexpr std::string_view kStyle =
    "<style>\n"
    "text { font: 14px sans-serif; fill: #222 }\n"
    ".title { font-size: 18px; font-weight: bold }\n"
    ".subtitle { font-size: 12px; fill: #555 }\n"
    ".grid { stroke: #ddd }\n"
    ".frame { fill: none; stroke: #555 }\n"
    ".guide { stroke: #777; stroke-width: 1.5; stroke-dasharray: 6 5 }\n"
    "</style>\n";

}  // namespace

std::string draw_svg(const Chart& chart) {
  const Frame frame = make_frame(chart);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "{2}<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
      kWidth, kHeight, kStyle);
  svg += text_at(kLeft, kTitleY, "class=\"title\"", chart.title);
  double y = kTitleY;
  for (const std::string& subtitle : chart.subtitles)
    svg += text_at(kLeft, y += kSubtitleStep, "class=\"subtitle\"", subtitle);
  svg += axes_svg(chart, frame) + guides_svg(chart, frame);
  const double middle = (static_cast<double>(chart.curves.size()) - 1) / 2;
  for (size_t i = 0; i < chart.curves.size(); ++i)
    svg += curve_svg(chart.curves[i], i, kBarShift * (static_cast<double>(i) - middle), frame);
  return svg + legend_svg(chart, frame) + "</svg>\n";
}

}  // namespace kaustik::app
