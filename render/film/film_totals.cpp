// Exact sums of films: choice of units, addition of passes, means.

#include "render/film/film_totals.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>

#include "core/math/transform.h"
#include "render/film/for_each_pixel.h"

namespace kaustik::render {

namespace {

// Exponent of the smallest power of two above x; 0 if x is not positive and finite.
int exponent_above(double x) {
  return x > 0 && std::isfinite(x) ? std::ilogb(x) + 1 : 0;
}

double size_of(const Scene& scene) {
  const double radius = double(scene.bounds.radius());
  return radius > 0 && std::isfinite(radius) ? radius : 1;
}

// Calls fn(row, i, c) for channel c of each layer that is summed; i counts the channels of all.
template <class Fn>
void for_each_sum(const Fn& fn) {
  size_t i = 0;
  for (const LayerRow& row : kLayerTable)
    for (size_t c = 0; row.summed() && c < row.channels.size(); ++c) fn(row, i++, c);
}

int exponent_of(LayerUnit unit, const ExactUnits& units) {
  switch (unit) {
    case LayerUnit::kRadiance:
      return units.radiance;
    case LayerUnit::kFeature:
      return ExactUnits::kFeature;
    case LayerUnit::kDepth:
      return units.depth;
    case LayerUnit::kCount:
      break;
  }
  return ExactUnits::kPhotons;
}

// Inverses of the units, computed once for a film.
struct PerUnit {
  std::array<double, kSumChannels> sums;
  double square;
  explicit PerUnit(const ExactUnits& units) : square(std::ldexp(1.0, -units.square)) {
    for_each_sum([&](const LayerRow& row, size_t i, size_t) {
      sums[i] = std::ldexp(1.0, -exponent_of(row.unit, units));
    });
  }
};

// Adds a pass's samples to a pixel's totals; returns how many sums were clamped.
uint64_t add_pixel(const PixelSum& samples, const PerUnit& per_unit, PixelTotals* totals) {
  if (samples.count == 0) return 0;
  const PixelSum pass = samples.completed();
  uint64_t clamped = 0;
  for_each_sum([&](const LayerRow& row, size_t i, size_t c) {
    clamped += !totals->sums[i].add(row.in(pass)[c], per_unit.sums[i]);
  });
  // With few samples, the weights of a negative filter may cancel; the number of samples is then used
  // instead.
  const double weight = static_cast<double>(pass.weight() > 0 ? uint64_t(pass.weight()) : pass.count);
  const glm::dvec3 mean = (pass.emitted + pass.direct + pass.caustic + pass.indirect) / weight;
  for (int c = 0; c < 3; ++c) {
    clamped += !totals->squares[size_t(c)].add(mean[c] * mean[c], per_unit.square);
    clamped += !totals->bias_squares[size_t(c)].add(pass.bias[c] * pass.bias[c], per_unit.square);
  }
  totals->weight += pass.weight();
  ++totals->passes;
  return clamped;
}

void add_pixel(const PixelTotals& part, PixelTotals* totals) {
  for (size_t i = 0; i < kSumChannels; ++i) totals->sums[i] += part.sums[i];
  for (size_t c = 0; c < 3; ++c) {
    totals->squares[c] += part.squares[c];
    totals->bias_squares[c] += part.bias_squares[c];
  }
  totals->weight += part.weight;
  totals->passes += part.passes;
}

PixelResult mean_of(const PixelTotals& totals, const PixelUnits& units) {
  PixelResult out;
  out.error = Rgb(kInfinity);  // a single film does not tell
  if (totals.weight == 0) return out;
  const double weight = static_cast<double>(totals.weight);
  for_each_sum([&](const LayerRow& row, size_t i, size_t c) {
    if (row.mean == LayerMean::kSamples)
      row.in(out)[c] = static_cast<float>(totals.sums[i].value(units.sums[i]) / weight);
  });
  return out;
}

// Upper bound of a channel after the sensor, relative to the brightest channel before.
double largest_gain(const Sensor& sensor) {
  double largest = 0;
  for (int row = 0; row < 3; ++row) {
    double sum = 0;
    for (int column = 0; column < 3; ++column) sum += std::abs(double(sensor.response[column][row]));
    largest = std::max(largest, sum);
  }
  return largest;
}

template <class Window>
bool same_window(const PixelWindow<PixelTotals>& a, const Window& b) {
  return a.width() == b.width() && a.height() == b.height() && a.x0() == b.x0() && a.y0() == b.y0() &&
         a.full_width() == b.full_width() && a.full_height() == b.full_height();
}

}  // namespace

PixelUnits::PixelUnits(const ExactUnits& units) : square(std::ldexp(1.0, units.square)) {
  for_each_sum([&](const LayerRow& row, size_t i, size_t) {
    sums[i] = std::ldexp(1.0, exponent_of(row.unit, units));
  });
}

ExactUnits choose_units(const Scene& scene, uint64_t samples_per_pass) {
  const double size = size_of(scene);
  double brightest = 0;
  for (const Light& light : scene.lights) brightest = std::max(brightest, brightness(light, size));
  // The sensor makes no channel larger than this factor times the brightest one.
  if (!scene.sensor.neutral) brightest *= largest_gain(scene.sensor);
  const Point3 eye = scene.camera.to_world.point(Point3(0));
  const double lens = double(scene.camera.lens_radius() * max_row_sum(scene.camera.to_world.linear));
  const double farthest = double(glm::distance(eye, scene.bounds.center())) + size + lens;
  const int samples = exponent_above(static_cast<double>(samples_per_pass));
  // Keeps squares within the range of double.
  const int light = std::clamp(exponent_above(brightest), -400, 400);
  return {.radiance = light + samples + 20 - ExactSum::kTermBits,
          .square = 2 * (light + 10) - ExactSum::kTermBits,
          .depth = exponent_above(farthest) + samples - ExactSum::kTermBits};
}

uint64_t FilmTotals::add(const FilmSums& pass) {
  if (!same_window(pixels_, pass)) throw std::invalid_argument("the films show different windows");
  const PerUnit per_unit(units_);
  std::atomic<uint64_t> clamped{0};
  for_each_pixel(pixels_.width(), pixels_.height(), [&](int x, int y) {
    if (const uint64_t n = add_pixel(pass.at(x, y), per_unit, &pixels_.at(x, y))) clamped += n;
  });
  return clamped;
}

void FilmTotals::add(const FilmTotals& other) {
  if (!same_window(pixels_, other.pixels_)) throw std::invalid_argument("the films show different windows");
  if (units_ != other.units_) throw std::invalid_argument("the films' sums have different units");
  for_each_pixel(pixels_.width(), pixels_.height(),
                 [&](int x, int y) { add_pixel(other.pixels_.at(x, y), &pixels_.at(x, y)); });
}

Film FilmTotals::mean() const {
  Film film = window_of<PixelResult>(pixels_);
  const PixelUnits units(units_);
  for_each_pixel(film.width(), film.height(),
                 [&](int x, int y) { film.at(x, y) = mean_of(pixels_.at(x, y), units); });
  return film;
}

Film mean_of(const FilmSums& pass, const ExactUnits& units, uint64_t* clamped) {
  Film film = window_of<PixelResult>(pass);
  const PerUnit per_unit(units);
  const PixelUnits values(units);
  std::atomic<uint64_t> out_of_range{0};
  for_each_pixel(film.width(), film.height(), [&](int x, int y) {
    PixelTotals totals;
    if (const uint64_t n = add_pixel(pass.at(x, y), per_unit, &totals)) out_of_range += n;
    film.at(x, y) = mean_of(totals, values);
  });
  *clamped += out_of_range;
  return film;
}

}  // namespace kaustik::render
