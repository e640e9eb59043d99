// Features, classes of light, estimated errors, and where the filter is taken.

#include "render/denoise/denoise.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "core/parallel/parallel.h"
#include "render/denoise/regression.h"
#include "render/picture/image_io.h"

namespace kaustik::render {

namespace {

using FeaturePlanes = std::array<Plane, kFeatures>;

// The harmonic mean of depths, which a far background hardly changes.
double usual_depth(const HalfFilm& halves) {
  double sum = 0;
  int64_t count = 0;
  for (int y = 0; y < halves.height(); ++y)
    for (int x = 0; x < halves.width(); ++x) {
      const float depth = halves.at(x, y).of_all(half_of(Layer::kDenoisingDepth));
      if (!(depth > 0)) continue;
      sum += 1 / double(depth);
      ++count;
    }
  return sum > 0 ? double(count) / sum : 1;
}

bool known(const HalfMeans& pixel) {
  return pixel.share[0] > 0;
}

// Albedo, normal, and depth as a number from 0 to 1 that does not depend on the unit of length.
FeaturePlanes features_of(const HalfFilm& halves) {
  static_assert(half_of(Layer::kDenoisingNormal) == half_of(Layer::kDenoisingAlbedo) + 3);
  static_assert(half_of(Layer::kDenoisingDepth) == half_of(Layer::kDenoisingAlbedo) + 6);
  constexpr size_t kDepth = 6;
  const double usual = usual_depth(halves);
  FeaturePlanes features;
  for (Plane& plane : features) plane = Plane(halves.width(), halves.height());
  for_each_pixel(halves.width(), halves.height(), [&](int x, int y) {
    for (size_t f = 0; f < kFeatures; ++f)
      features[f].at(x, y) = halves.at(x, y).of_all(half_of(Layer::kDenoisingAlbedo) + f);
    float& depth = features[kDepth].at(x, y);
    depth = depth > 0 ? float(double(depth) / (double(depth) + usual)) : 0;
  });
  return features;
}

// The numbers of the picture that do not belong to one class of light.
struct Picture {
  const HalfFilm& halves;
  FeaturePlanes features;
  Plane inside;  // 1 where there are two halves, else 0

  int width() const { return halves.width(); }
  int height() const { return halves.height(); }
};

// The samples of one class of light, divided by factor().
struct ClassOfLight {
  Layer layer{};
  std::array<ColourPlanes, 2> half;  // means of the halves
  ColourPlanes mean, variance;       // of all samples; of that mean, averaged over 3 x 3 pixels
  Plane noise;                       // the sum of the variances
  bool dark = true;                  // in all pixels

  ClassOfLight(int width, int height) {
    for (ColourPlanes* planes : {&half[0], &half[1], &mean, &variance})
      for (Plane& plane : *planes) plane = Plane(width, height);
  }
};

// What the light of a class is divided by: the albedo, where surfaces scatter it diffusely.
float factor(const Picture& picture, Layer layer, size_t channel, int x, int y) {
  constexpr float kLeastAlbedo = 0.02f;
  return layer == Layer::kDenoisingEmitted ? 1 : std::max(picture.features[channel].at(x, y), kLeastAlbedo);
}

// Estimated squared error of the mean of a pixel's samples, in one channel.
float error_of_samples(float a, float b, const HalfMeans& pixel) {
  return (a - b) * (a - b) * pixel.share[0] * pixel.share[1];
}

void set_class(const Picture& picture, Layer layer, ClassOfLight* light) {
  ClassOfLight& out = *light;
  out.layer = layer;
  std::atomic<bool> lit{false};
  parallel::for_index(0, picture.height(), [&](int y) {
    bool lit_row = false;
    for (int x = 0; x < picture.width(); ++x) {
      const HalfMeans& pixel = picture.halves.at(x, y);
      for (size_t c = 0; c < 3; ++c) {
        const float over = 1 / factor(picture, layer, c, x, y);
        const float a = pixel.mean[0][half_of(layer) + c] * over,
                    b = pixel.mean[1][half_of(layer) + c] * over;
        lit_row |= a != 0 || b != 0;
        out.half[0][c].at(x, y) = a;
        out.half[1][c].at(x, y) = b;
        out.mean[c].at(x, y) = pixel.share[0] * a + pixel.share[1] * b;
        out.variance[c].at(x, y) = error_of_samples(a, b, pixel);
      }
    }
    if (lit_row) lit = true;
  });
  out.dark = !lit;
  if (out.dark) return;
  for (Plane& plane : out.variance) plane = blurred(plane, 1);
  out.noise = plane_of(picture.width(), picture.height(), [&](int x, int y) {
    return out.variance[0].at(x, y) + out.variance[1].at(x, y) + out.variance[2].at(x, y);
  });
  out.noise.extend();  // patches reach over the picture's edge
  for (ColourPlanes* planes : {&out.mean, &out.variance})
    for (Plane& plane : *planes) plane.extend();
}

// That of a filter, from the filtered halves. fa differs from b by its own error and by b's noise, so the
// latter's variance is subtracted; and the mean of fa and fb has less noise than either.
float error_of_filter(float fa, float fb, float a, float b, const HalfMeans& pixel) {
  const float variance = error_of_samples(a, b, pixel);
  const float across = (fa - b) * (fa - b) + (fb - a) * (fb - a);
  const float noise = variance / pixel.share[0] + variance / pixel.share[1];
  return 0.5f * (across - noise) - 0.25f * (fa - fb) * (fa - fb);
}

// What the filter makes of a class of light.
struct Filtered {
  ColourPlanes change;  // of the radiance
  // By how much the filter lowers the estimated squared error, the sum of the channels; not yet averaged over
  // neighbours.
  Plane gain;
};

Filtered filtered(const Picture& picture, const ClassOfLight& light, Regression* regression) {
  RegressionInput in{};
  for (size_t c = 0; c < 3; ++c) {
    in.guide[c] = &light.mean[c], in.variance[c] = &light.variance[c];
    in.targets[c] = &light.half[0][c], in.targets[3 + c] = &light.half[1][c];
  }
  for (size_t f = 0; f < kFeatures; ++f) in.features[f] = &picture.features[f];
  in.noise = &light.noise;
  in.inside = &picture.inside;
  const Fitted& fitted = regression->fit(in);
  Filtered out;
  for (Plane* plane : {&out.change[0], &out.change[1], &out.change[2], &out.gain})
    *plane = Plane(picture.width(), picture.height());
  for_each_pixel(picture.width(), picture.height(), [&](int x, int y) {
    const HalfMeans& pixel = picture.halves.at(x, y);
    if (!known(pixel)) return;
    float gain = 0;
    for (size_t c = 0; c < 3; ++c) {
      const float times = factor(picture, light.layer, c, x, y);
      const float fa = fitted[c].at(x, y), fb = fitted[3 + c].at(x, y);
      const float a = light.half[0][c].at(x, y), b = light.half[1][c].at(x, y);
      gain += times * times * (error_of_samples(a, b, pixel) - error_of_filter(fa, fb, a, b, pixel));
      out.change[c].at(x, y) = times * (pixel.share[0] * (fa - a) + pixel.share[1] * (fb - b));
    }
    out.gain.at(x, y) = gain;
  });
  return out;
}

// The squared radiance by which errors are divided: that of the filtered picture, since a pixel with an
// outlier would be divided by the outlier.
Plane squared_level(const Film& film, const std::vector<Filtered>& classes) {
  constexpr double kLeast = 0.1;  // of the picture's mean
  Plane level = plane_of(film.width(), film.height(), [&](int x, int y) {
    Rgb sum = film.at(x, y).radiance();
    for (const Filtered& light : classes)
      for (size_t c = 0; c < 3; ++c) sum[int(c)] += light.change[c].at(x, y);
    return (sum.x + sum.y + sum.z) / 3;
  });
  double sum = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) sum += std::abs(double(level.at(x, y)));
  const double least = kLeast * sum / (double(film.width()) * double(film.height()));
  for_each_pixel(film.width(), film.height(), [&](int x, int y) {
    const double value = level.at(x, y);
    level.at(x, y) = float(value * value + least * least);
  });
  return level;
}

// Adds what the filter changes where it lowers the error, as averaged over the neighbours. The border of such
// a region is soft.
void apply(Filtered& light, const Plane& level, Image* image) {
  for_each_pixel(image->width, image->height, [&](int x, int y) { light.gain.at(x, y) /= level.at(x, y); });
  Plane taken = blurred(blurred(light.gain, 2), 2);
  for_each_pixel(image->width, image->height,
                 [&](int x, int y) { taken.at(x, y) = taken.at(x, y) > 0 ? 1.0f : 0.0f; });
  taken = blurred(taken, 2);
  for_each_pixel(image->width, image->height, [&](int x, int y) {
    if (taken.at(x, y) > 0)
      for (size_t c = 0; c < 3; ++c) image->at(x, y)[int(c)] += taken.at(x, y) * light.change[c].at(x, y);
  });
}

// A plane that is fitted beside an edge may fall below zero. Light does so only where colours are outside the
// gamut, and then the samples tell.
void keep_sign(const Film& film, Image* image) {
  for_each_pixel(image->width, image->height, [&](int x, int y) {
    const Rgb least = glm::min(film.at(x, y).radiance(), Rgb(0));
    image->at(x, y) = glm::max(image->at(x, y), least);
  });
}

}  // namespace

bool any_halves(const HalfFilm& halves) {
  for (int y = 0; y < halves.height(); ++y)
    for (int x = 0; x < halves.width(); ++x)
      if (known(halves.at(x, y))) return true;
  return false;
}

Image denoise(const Film& film, const HalfFilm& halves) {
  Image image = image_of(film);
  const Picture picture{halves, features_of(halves), plane_of(film.width(), film.height(), [&](int x, int y) {
                          return known(halves.at(x, y)) ? 1.0f : 0.0f;
                        })};
  std::vector<Filtered> classes;
  ClassOfLight light(film.width(), film.height());
  Regression regression(film.width(), film.height());
  for (const Layer layer : kFilteredLight) {
    set_class(picture, layer, &light);
    if (!light.dark) classes.push_back(filtered(picture, light, &regression));
  }
  if (classes.empty()) return image;
  const Plane level = squared_level(film, classes);
  for (Filtered& filter : classes) apply(filter, level, &image);
  keep_sign(film, &image);
  return image;
}

}  // namespace kaustik::render
