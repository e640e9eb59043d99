// The regression in SIMD lanes (Google Highway): a lane for the window about each pixel of a row.

#include "render/denoise/regression.h"

#include <algorithm>
#include <memory>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/denoise/regression.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
//
#include <hwy/contrib/math/math-inl.h>

#include "core/parallel/parallel.h"

#ifndef KAUSTIK_REGRESSION_BAND
#define KAUSTIK_REGRESSION_BAND
namespace kaustik::render {

// Windows are centred in tiles of this size, which share the distances of patches; a band is a row of tiles.
inline constexpr int kTileWidth = 32, kTileHeight = 16;
inline constexpr int kSide = 2 * kReach + 1, kOffsets = kSide * kSide;
// Pixels of a window, column by column. One that follows another lies in another row: the sums of a row that
// were just stored cannot be loaded again, one float further, without a delay.
constexpr int Dx(int offset) {
  return offset / kSide - kReach;
}
constexpr int Dy(int offset) {
  return offset % kSide - kReach;
}

// Where the windows of a band add their predictions: the band's rows and those that its windows reach. Bands
// have sums of their own, which are added in their order, so that threads do not change the result.
class BandSums {
 public:
  static constexpr int kRows = kTileHeight + 2 * kReach;
  static constexpr size_t kSums = kTargets + 1;  // the weights last

  explicit BandSums(int width)
      : stride_(size_t(width) + Plane::kBorder + Plane::kRightBorder), values_(kSums * kRows * stride_) {}
  void clear() { std::fill(values_.begin(), values_.end(), 0.0f); }
  // y is counted from the band's first row.
  float* row(size_t sum, int x, int y) {
    return &values_[(sum * kRows + size_t(y + kReach)) * stride_ + size_t(x + Plane::kBorder)];
  }
  float at(size_t sum, int x, int y) const { return const_cast<BandSums*>(this)->row(sum, x, y)[0]; }

 private:
  size_t stride_;
  std::vector<float, UninitialisedAllocator<float>> values_;
};

}  // namespace kaustik::render
#endif

HWY_BEFORE_NAMESPACE();
namespace kaustik::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Vf = hn::Vec<Floats>;

// Terms of a fit: the constant, features, x and y.
constexpr int TermsOf(int features) {
  return 1 + features + 2;
}
// Position of entry (i, j), j <= i, of a symmetric matrix.
constexpr int Pair(int i, int j) {
  return i * (i + 1) / 2 + j;
}

// What a thread needs for a tile.
struct Scratch {
  // For each group of as many windows as there are lanes, of each row of the tile: the distances of all
  // offsets.
  alignas(64) float distances[kTileHeight * kTileWidth * kOffsets];
  // Of one group, without the offsets that have no weight in any of its windows.
  int offsets[kOffsets];
  alignas(64) float weights[kOffsets][16];
  alignas(64) float terms[kOffsets][TermsOf(kFeatures)][16];
  alignas(64) float targets[kOffsets][kTargets][16];
};

// The features of a tile, those that vary in its windows first.
struct TileFeatures {
  std::array<const Plane*, kFeatures> planes;
  size_t varying = 0;
};

// Squared difference of two pixels of the guide less what noise explains, over the variance of noise.
HWY_INLINE Vf Distance(const RegressionInput& in, int x, int y, int dx, int dy) {
  const Floats d;
  const Vf noise_at_p = hn::LoadU(d, in.noise->row(x, y));
  const Vf noise = hn::Add(noise_at_p, hn::LoadU(d, in.noise->row(x + dx, y + dy)));
  Vf squares = hn::Zero(d), explained = noise_at_p;
  for (size_t c = 0; c < 3; ++c) {
    const Vf step =
        hn::Sub(hn::LoadU(d, in.guide[c]->row(x, y)), hn::LoadU(d, in.guide[c]->row(x + dx, y + dy)));
    squares = hn::MulAdd(step, step, squares);
    explained = hn::Add(explained, hn::Min(hn::LoadU(d, in.variance[c]->row(x, y)),
                                           hn::LoadU(d, in.variance[c]->row(x + dx, y + dy))));
  }
  // A patch that differs in one pixel by a hundred standard deviations differs.
  return hn::Min(hn::Div(hn::Sub(squares, explained), hn::Add(noise, hn::Set(d, 1e-30f))), hn::Set(d, 1e4f));
}

// Mean distances of the patches about the pixels of a tile from those that lie (dx, dy) from them.
void PatchDistances(const RegressionInput& in, int x0, int y0, int offset, Scratch* scratch) {
  const Floats d;
  const int lanes = int(hn::Lanes(d));
  const int dx = Dx(offset), dy = Dy(offset);
  constexpr int kRows = kTileHeight + 2 * kPatchReach, kStride = kTileWidth + 16;
  alignas(64) float pixels[kRows][kStride], columns[kStride];
  const int rows = std::min(kTileHeight, in.inside->height() - y0);
  for (int y = 0; y < rows + 2 * kPatchReach; ++y)
    for (int x = 0; x < kTileWidth + 2 * kPatchReach; x += lanes)
      hn::Store(Distance(in, x0 + x - kPatchReach, y0 + y - kPatchReach, dx, dy), d, pixels[y] + x);
  constexpr float kPixels = (2 * kPatchReach + 1) * (2 * kPatchReach + 1);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < kTileWidth + 2 * kPatchReach; x += lanes) {
      Vf sum = hn::Load(d, pixels[y] + x);
      for (int v = 1; v <= 2 * kPatchReach; ++v) sum = hn::Add(sum, hn::Load(d, pixels[y + v] + x));
      hn::Store(sum, d, columns + x);
    }
    for (int x = 0; x < kTileWidth; x += lanes) {
      Vf sum = hn::Load(d, columns + x);
      for (int u = 1; u <= 2 * kPatchReach; ++u) sum = hn::Add(sum, hn::LoadU(d, columns + x + u));
      const int group = (y * kTileWidth + x) / lanes;
      hn::Store(hn::Mul(sum, hn::Set(d, 1 / kPixels)), d,
                scratch->distances + size_t(group * kOffsets + offset) * size_t(lanes));
    }
  }
}

// The windows about `lanes` pixels from (x, y) on, with the first kUsed features of the tile.
template <int kUsed>
class Windows {
 public:
  static constexpr int kTerms = TermsOf(kUsed), kPairs = kTerms * (kTerms + 1) / 2;

  Windows(const RegressionInput& in, const TileFeatures& features, int x, int y, Scratch* scratch)
      : in_(in), features_(features), x_(x), y_(y), scratch_(*scratch) {}

  // Sets the weights from the distances of patches, and the terms where they are needed.
  void Weigh(const float* distances) {
    const Floats d;
    const size_t lanes = hn::Lanes(d);
    const Vf scale = hn::Set(d, -1 / (kBandwidth * kBandwidth));
    const Vf inside = hn::LoadU(d, in_.inside->row(x_, y_));
    used_ = 0;
    for (int o = 0; o < kOffsets; ++o) {
      const Vf exponent = hn::Mul(hn::Max(hn::Load(d, distances + size_t(o) * lanes), hn::Zero(d)), scale);
      // Weights below e^-10 are left out: they do not matter, and their products would be denormal and slow.
      const Vf least = hn::Set(d, -10);
      if (hn::AllFalse(d, hn::Gt(exponent, least))) continue;
      const Vf w = hn::IfThenElseZero(hn::Gt(exponent, least), hn::Exp(d, hn::Max(exponent, least)));
      const Vf both = hn::Mul(inside, hn::LoadU(d, in_.inside->row(x_ + Dx(o), y_ + Dy(o))));
      hn::Store(hn::Mul(w, both), d, scratch_.weights[used_]);
      SetTerms(o);
      scratch_.offsets[used_++] = o;
    }
  }

  void Fit() {
    for (Vf& sum : matrix_) sum = hn::Zero(Floats());
    for (auto& row : coefficients_)
      for (Vf& sum : row) sum = hn::Zero(Floats());
    for (int first = 0; first < used_; first += kSide) Sum<0>(first, std::min(first + kSide, used_));
    Regularise();
    Factorise();
    for (int c = 0; c < int(kTargets); ++c) Solve(c);
  }

  // Adds the predictions to the band's sums; y is counted from its first row.
  void Predict(int y, BandSums* sums) const {
    const Floats d;
    for (int n = 0; n < used_; ++n) {
      const int o = scratch_.offsets[n];
      const Vf w = hn::Load(d, scratch_.weights[n]);
      for (int c = 0; c < int(kTargets); ++c) {
        Vf value = coefficients_[0][c];
        for (int i = 1; i < kTerms; ++i)
          value = hn::MulAdd(coefficients_[i][c], hn::Load(d, scratch_.terms[n][i]), value);
        AddTo(sums->row(size_t(c), x_ + Dx(o), y + Dy(o)), hn::Mul(w, value));
      }
      AddTo(sums->row(kTargets, x_ + Dx(o), y + Dy(o)), w);
    }
  }

 private:
  static void AddTo(float* to, Vf value) {
    const Floats d;
    hn::StoreU(hn::Add(hn::LoadU(d, to), value), d, to);
  }

  // The terms and targets of the pixel at an offset, for the next place.
  HWY_INLINE void SetTerms(int o) {
    const Floats d;
    float(*const terms)[16] = scratch_.terms[used_];
    hn::Store(hn::Set(d, 1), d, terms[0]);
    for (size_t f = 0; f < size_t(kUsed); ++f) {
      const Plane& feature = *features_.planes[f];
      hn::Store(hn::Sub(hn::LoadU(d, feature.row(x_ + Dx(o), y_ + Dy(o))), hn::LoadU(d, feature.row(x_, y_))),
                d, terms[1 + f]);
    }
    hn::Store(hn::Set(d, float(Dx(o)) / kReach), d, terms[kTerms - 2]);
    hn::Store(hn::Set(d, float(Dy(o)) / kReach), d, terms[kTerms - 1]);
    for (size_t c = 0; c < kTargets; ++c)
      hn::Store(hn::LoadU(d, in_.targets[c]->row(x_ + Dx(o), y_ + Dy(o))), d, scratch_.targets[used_][c]);
  }

  // Adds some pixels of the window to rows i and further of the normal equations: as many pixels as stay in
  // the first-level cache, and a row of the equations, so that its sums stay in registers.
  template <int i>
  HWY_INLINE void Sum(int first, int end) {
    const Floats d;
    Vf products[i + 1], targets[kTargets];
    for (int j = 0; j <= i; ++j) products[j] = matrix_[Pair(i, j)];
    for (size_t c = 0; c < kTargets; ++c) targets[c] = coefficients_[i][c];
    for (int n = first; n < end; ++n) {
      const Vf w = hn::Load(d, scratch_.weights[n]);
      const Vf weighted = i == 0 ? w : hn::Mul(w, hn::Load(d, scratch_.terms[n][i]));
      for (int j = 0; j <= i; ++j)
        products[j] = hn::MulAdd(weighted, hn::Load(d, scratch_.terms[n][j]), products[j]);
      for (size_t c = 0; c < kTargets; ++c)
        targets[c] = hn::MulAdd(weighted, hn::Load(d, scratch_.targets[n][c]), targets[c]);
    }
    for (int j = 0; j <= i; ++j) matrix_[Pair(i, j)] = products[j];
    for (size_t c = 0; c < kTargets; ++c) coefficients_[i][c] = targets[c];
    if constexpr (i + 1 < kTerms) Sum<i + 1>(first, end);
  }

  // A ridge decides what the window does not: terms that do not vary in it get no coefficient.
  void Regularise() {
    constexpr float kRidge = 1e-3f, kLeast = 1e-12f;
    const Floats d;
    for (int i = 1; i < kTerms; ++i)
      matrix_[Pair(i, i)] =
          hn::Add(hn::MulAdd(matrix_[0], hn::Set(d, kRidge), matrix_[Pair(i, i)]), hn::Set(d, kLeast));
    matrix_[0] = hn::Add(matrix_[0], hn::Set(d, kLeast));
  }

  // Cholesky factors; the diagonal holds inverses.
  void Factorise() {
    constexpr float kLeast = 1e-14f;
    const Floats d;
    for (int i = 0; i < kTerms; ++i)
      for (int j = 0; j <= i; ++j) {
        Vf sum = matrix_[Pair(i, j)];
        for (int k = 0; k < j; ++k) sum = hn::NegMulAdd(matrix_[Pair(i, k)], matrix_[Pair(j, k)], sum);
        matrix_[Pair(i, j)] = i == j ? hn::Div(hn::Set(d, 1), hn::Sqrt(hn::Max(sum, hn::Set(d, kLeast))))
                                     : hn::Mul(sum, matrix_[Pair(j, j)]);
      }
  }

  void Solve(int c) {
    for (int i = 0; i < kTerms; ++i) {
      Vf sum = coefficients_[i][c];
      for (int k = 0; k < i; ++k) sum = hn::NegMulAdd(matrix_[Pair(i, k)], coefficients_[k][c], sum);
      coefficients_[i][c] = hn::Mul(sum, matrix_[Pair(i, i)]);
    }
    for (int i = kTerms - 1; i >= 0; --i) {
      Vf sum = coefficients_[i][c];
      for (int k = i + 1; k < kTerms; ++k) sum = hn::NegMulAdd(matrix_[Pair(k, i)], coefficients_[k][c], sum);
      coefficients_[i][c] = hn::Mul(sum, matrix_[Pair(i, i)]);
    }
  }

  const RegressionInput& in_;
  const TileFeatures& features_;
  int x_, y_, used_ = 0;
  Scratch& scratch_;
  Vf matrix_[kPairs];
  Vf coefficients_[kTerms][kTargets];  // first the right sides
};

// Whether a target differs from 0 in any window of a tile.
bool IsLit(const RegressionInput& in, int x0, int y0) {
  const Floats d;
  Vf most = hn::Zero(d);
  for (const Plane* target : in.targets)
    for (int y = y0 - kReach; y < std::min(y0 + kTileHeight, in.inside->height()) + kReach; ++y)
      for (int x = x0 - kReach; x < x0 + kTileWidth + kReach; x += int(hn::Lanes(d)))
        most = hn::Max(most, hn::Abs(hn::LoadU(d, target->row(x, y))));
  return !hn::AllTrue(d, hn::Eq(most, hn::Zero(d)));
}

// Whether a feature varies so much in the windows of a tile that it has a say in a fit. The ridge allows a
// term that varies less than that no more than a thousandth of the coefficient that it would have without.
bool Varies(const Plane& feature, int x0, int y0) {
  constexpr float kLeastRange = 0.002f;
  const int x1 = std::min(x0 + kTileWidth + kReach, feature.width());
  const int y1 = std::min(y0 + kTileHeight + kReach, feature.height());
  float least = feature.at(x0, y0), most = least;
  for (int y = std::max(y0 - kReach, 0); y < y1; ++y) {
    const float* const row = feature.row(0, y);
    for (int x = std::max(x0 - kReach, 0); x < x1; ++x) {
      least = std::min(least, row[x]);
      most = std::max(most, row[x]);
    }
  }
  return most - least > kLeastRange;
}

TileFeatures FeaturesOf(const RegressionInput& in, int x0, int y0) {
  TileFeatures out{in.features};
  const auto end = std::stable_partition(out.planes.begin(), out.planes.end(),
                                         [&](const Plane* plane) { return Varies(*plane, x0, y0); });
  out.varying = size_t(end - out.planes.begin());
  return out;
}

template <int kUsed>
void RegressTile(const RegressionInput& in, const TileFeatures& features, int x0, int y0, Scratch* scratch,
                 BandSums* sums) {
  const int lanes = int(hn::Lanes(Floats()));
  const int width = in.inside->width(), rows = std::min(kTileHeight, in.inside->height() - y0);
  for (int o = 0; o < kOffsets; ++o) PatchDistances(in, x0, y0, o, scratch);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < kTileWidth && x0 + x < width; x += lanes) {
      Windows<kUsed> windows(in, features, x0 + x, y0 + y, scratch);
      const int group = (y * kTileWidth + x) / lanes;
      windows.Weigh(scratch->distances + size_t(group) * kOffsets * size_t(lanes));
      windows.Fit();
      windows.Predict(y, sums);
    }
}

void RegressBand(const RegressionInput& in, int y0, BandSums* sums) {
  const auto scratch = std::make_unique<Scratch>();
  for (int x0 = 0; x0 < in.inside->width(); x0 += kTileWidth) {
    if (!IsLit(in, x0, y0)) continue;  // the targets stay as they are
    const TileFeatures features = FeaturesOf(in, x0, y0);
    const auto regress = features.varying == 0   ? RegressTile<0>
                         : features.varying == 1 ? RegressTile<1>
                         : features.varying <= 4 ? RegressTile<4>
                                                 : RegressTile<int(kFeatures)>;
    regress(in, features, x0, y0, scratch.get(), sums);
  }
}

}  // namespace kaustik::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::render {

namespace {

HWY_EXPORT(RegressBand);

// The mean of the predictions that the bands about a row hold for its pixels.
void add_up(const std::vector<BandSums>& bands, int y, const RegressionInput& in, Fitted* out) {
  constexpr float kLeastWeight = 1e-3f;
  for (int x = 0; x < in.inside->width(); ++x) {
    std::array<float, BandSums::kSums> sums{};
    for (int band = std::max(0, (y - kReach) / kTileHeight - 1); band < int(bands.size()); ++band) {
      const int row = y - band * kTileHeight;
      if (row < -kReach) break;
      if (row >= kTileHeight + kReach) continue;
      for (size_t i = 0; i < BandSums::kSums; ++i) sums[i] += bands[size_t(band)].at(i, x, row);
    }
    for (size_t c = 0; c < kTargets; ++c)
      (*out)[c].at(x, y) = sums[kTargets] > kLeastWeight ? sums[c] / sums[kTargets] : in.targets[c]->at(x, y);
  }
}

}  // namespace

Regression::Regression(int width, int height) {
  for (int y = 0; y < height; y += kTileHeight) bands_.emplace_back(width);
  for (Plane& plane : fitted_) plane = Plane(width, height);
}

Regression::~Regression() = default;

const Fitted& Regression::fit(const RegressionInput& in) {
  parallel::for_index(
      size_t(0), bands_.size(),
      [&](size_t band) {
        bands_[band].clear();
        HWY_DYNAMIC_DISPATCH(RegressBand)(in, int(band) * kTileHeight, &bands_[band]);
      },
      parallel::Division::kEach);
  parallel::for_index(0, in.inside->height(), [&](int y) { add_up(bands_, y, in, &fitted_); });
  return fitted_;
}

}  // namespace kaustik::render
#endif
