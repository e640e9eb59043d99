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
  for_each_channel([](const LayerRow& row) { return row.summed(); }, fn);
}

// A sum that has the unit of radiance, as all that media scatter has.
constexpr size_t kRadianceSum = sum_of(Layer::kDirect);

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

// Adds the half of a pass's samples that is summed apart. pass: all its samples.
void add_half(const HalfSum& half, const PixelSum& pass, const PerUnit& per_unit, HalfTotals* totals) {
  const double weight = double(half.weight), other_weight = double(pass.weight()) - weight;
  const double maps = double(half.maps_weight);
  const double other_maps = double(pass.weight() - int64_t(pass.traced)) - maps;
  const bool known = maps > 0 && other_maps > 0;
  const double all_maps = std::max(maps + other_maps, 1.0);
  size_t map_channel = 0;
  for_each_half_channel([&](const LayerRow& row, size_t i, size_t c) {
    const double unit = per_unit.sums[sum_of(row.layer) + c], sum = half.sums[i], all = row.in(pass)[c];
    if (!row.from_maps) {
      totals->sums[i].add(sum, unit);
      return;
    }
    // Where no sample of a half computed this light, all samples stand in.
    totals->sums[i].add(weight * (known ? sum / maps : all / all_maps), unit);
    totals->other_maps[map_channel++].add(other_weight * (known ? (all - sum) / other_maps : all / all_maps),
                                          unit);
  });
  totals->weight += half.weight;
}

// Adds what media scatter. pass: the pass's samples. Returns how many sums were clamped.
uint64_t add_media(const MediaSum& media, const PixelSum& pass, const PerUnit& per_unit,
                   MediaTotals* totals) {
  const double per_radiance = per_unit.sums[kRadianceSum];
  uint64_t clamped = 0;
  for_each_media_channel([&](const LayerRow& row, size_t i, size_t) {
    clamped += !totals->sums[i].add(media.sums[i] * (row.from_maps ? pass.completion() : 1), per_radiance);
  });
  return clamped;
}

HalfSum as_half(const PixelSum& pass) {
  HalfSum half{.weight = pass.weight(), .maps_weight = pass.weight() - int64_t(pass.traced)};
  for_each_half_channel([&](const LayerRow& row, size_t i, size_t c) { half.sums[i] = row.in(pass)[c]; });
  return half;
}

void add_half(const HalfTotals& part, HalfTotals* totals) {
  for (size_t i = 0; i < kHalfChannels; ++i) totals->sums[i] += part.sums[i];
  for (size_t i = 0; i < kHalfMapChannels; ++i) totals->other_maps[i] += part.other_maps[i];
  totals->weight += part.weight;
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

// Sets the mean of what media scatter. weight: of the samples.
void show_media(const MediaTotals& media, const PixelUnits& units, int64_t weight, PixelResult* out) {
  if (weight == 0) return;
  const double radiance = units.sums[kRadianceSum];
  for_each_media_channel([&](const LayerRow& row, size_t i, size_t c) {
    row.in(*out)[c] = static_cast<float>(media.sums[i].value(radiance) / static_cast<double>(weight));
  });
}

HalfMeans halves_of(const HalfTotals& half, const PixelTotals& all, const PixelUnits& units) {
  HalfMeans out;
  const double weight = double(half.weight), other_weight = double(all.weight) - weight;
  if (!(weight > 0 && other_weight > 0)) return out;
  out.share = {float(other_weight / double(all.weight)), float(weight / double(all.weight))};
  size_t map_channel = 0;
  for_each_half_channel([&](const LayerRow& row, size_t i, size_t c) {
    const size_t in_all = sum_of(row.layer) + c;
    const double unit = units.sums[in_all], sum = half.sums[i].value(unit);
    const double other =
        row.from_maps ? half.other_maps[map_channel++].value(unit) : all.sums[in_all].value(unit) - sum;
    out.mean[0][i] = float(other / other_weight);
    out.mean[1][i] = float(sum / weight);
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
  for (const Medium& medium : scene.media)
    if (medium.emits()) brightest = std::max(brightest, double(max_component(medium.Le)));
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
          // A chain of delta lobes may be several times as long as the scene is large.
          .depth = exponent_above(farthest) + 4 + samples - ExactSum::kTermBits};
}

void FilmTotals::keep_halves() {
  halves_ = window_of<HalfTotals>(pixels_);
}

void FilmTotals::keep_media() {
  media_ = window_of<MediaTotals>(pixels_);
}

uint64_t FilmTotals::add(const FilmSums& pass, const HalfSums* half, const MediaSums* media) {
  return add_pass(pass, media,
                  [half](int x, int y, const PixelSum&) { return half ? half->at(x, y) : HalfSum{}; });
}

uint64_t FilmTotals::add_as_half(const FilmSums& pass, const MediaSums* media) {
  return add_pass(pass, media, [](int, int, const PixelSum& all) { return as_half(all); });
}

template <class HalfOf>
uint64_t FilmTotals::add_pass(const FilmSums& pass, const MediaSums* media, const HalfOf& half_of) {
  if (!same_window(pixels_, pass)) throw std::invalid_argument("the films show different windows");
  const PerUnit per_unit(units_);
  std::atomic<uint64_t> clamped{0};
  for_each_pixel(pixels_.width(), pixels_.height(), [&](int x, int y) {
    const PixelSum& samples = pass.at(x, y);
    uint64_t n = add_pixel(samples, per_unit, &pixels_.at(x, y));
    if (has_media()) n += add_media(media->at(x, y), samples, per_unit, &media_.at(x, y));
    if (n > 0) clamped += n;
    if (has_halves()) add_half(half_of(x, y, samples), samples, per_unit, &halves_.at(x, y));
  });
  return clamped;
}

void FilmTotals::add(const FilmTotals& other) {
  if (!same_window(pixels_, other.pixels_)) throw std::invalid_argument("the films show different windows");
  if (units_ != other.units_) throw std::invalid_argument("the films' sums have different units");
  if (has_halves() != other.has_halves())
    throw std::invalid_argument("only one of the films has its samples in halves");
  if (has_media() != other.has_media())
    throw std::invalid_argument("only one of the films has the layers of media");
  for_each_pixel(pixels_.width(), pixels_.height(), [&](int x, int y) {
    add_pixel(other.pixels_.at(x, y), &pixels_.at(x, y));
    if (has_halves()) add_half(other.halves_.at(x, y), &halves_.at(x, y));
    if (has_media()) media_.at(x, y) += other.media_.at(x, y);
  });
}

Film FilmTotals::mean() const {
  Film film = window_of<PixelResult>(pixels_);
  const PixelUnits units(units_);
  for_each_pixel(film.width(), film.height(), [&](int x, int y) {
    const PixelTotals& totals = pixels_.at(x, y);
    film.at(x, y) = mean_of(totals, units);
    if (has_media()) show_media(media_.at(x, y), units, totals.weight, &film.at(x, y));
  });
  return film;
}

HalfFilm FilmTotals::halves() const {
  HalfFilm film = window_of<HalfMeans>(pixels_);
  const PixelUnits units(units_);
  for_each_pixel(film.width(), film.height(),
                 [&](int x, int y) { film.at(x, y) = halves_of(halves_.at(x, y), pixels_.at(x, y), units); });
  return film;
}

Film mean_of(const FilmSums& pass, const ExactUnits& units, uint64_t* clamped, const MediaSums* media) {
  Film film = window_of<PixelResult>(pass);
  const PerUnit per_unit(units);
  const PixelUnits values(units);
  std::atomic<uint64_t> out_of_range{0};
  for_each_pixel(film.width(), film.height(), [&](int x, int y) {
    PixelTotals totals;
    MediaTotals of_media;
    uint64_t n = add_pixel(pass.at(x, y), per_unit, &totals);
    if (media) n += add_media(media->at(x, y), pass.at(x, y), per_unit, &of_media);
    if (n > 0) out_of_range += n;
    film.at(x, y) = mean_of(totals, values);
    if (media) show_media(of_media, values, totals.weight, &film.at(x, y));
  });
  *clamped += out_of_range;
  return film;
}

HalfFilm halves_of(const FilmSums& pass, const HalfSums& half, const ExactUnits& units) {
  HalfFilm film = window_of<HalfMeans>(pass);
  const PerUnit per_unit(units);
  const PixelUnits values(units);
  for_each_pixel(film.width(), film.height(), [&](int x, int y) {
    PixelTotals all;
    HalfTotals part;
    add_pixel(pass.at(x, y), per_unit, &all);
    add_half(half.at(x, y), pass.at(x, y), per_unit, &part);
    film.at(x, y) = halves_of(part, all, values);
  });
  return film;
}

}  // namespace kaustik::render
