// Evaluation of textures.

#include "core/texture/texture.h"

#include <cmath>

namespace kaustik {

namespace {

float floor_of_half(float x) {
  return std::floor(x / 2);
}

// Second integral of the square wave that is 1 on even unit intervals and -1 on odd ones, up to a linear term
// that cancels in the differences below.
float second_integral(float x) {
  const float y = x / 2 - floor_of_half(x) - 0.5f;
  return x / 2 + y * (1 - 2 * std::abs(y));
}

// The square wave convolved with a triangle filter of half width r at x (Pharr 2023, equation 10.11). If a
// single edge is in reach, at distance d, the result is 1 - (1 - d / r)^2 times the field that x is in;
// there, differences of the second integral would be lost to rounding.
float square_wave(float x, float r) {
  x -= 2 * floor_of_half(x);
  const auto field = [](float floor_x) { return 1 - 2 * (floor_x - 2 * floor_of_half(floor_x)); };
  const float edge = std::floor(x + r);
  if (std::floor(x - r) == edge) return field(edge);
  if (r < 0.5f) {
    const float inside = 1 - std::min(std::abs(x - edge) / r, 1.0f);
    return field(std::floor(x)) * (1 - inside * inside);
  }
  return (second_integral(x + r) - 2 * second_integral(x) + second_integral(x - r)) / (r * r);
}

// Half width of the triangle filter, 1.5 times the footprint.
float filter_radius(float along_x, float along_y) {
  return 1.5f * std::max(std::abs(along_x), std::abs(along_y));
}

// Weight of tex2.
float checkerboard_weight(const CheckerboardTexture& board, const TextureContext& c) {
  if (!board.solid) {
    const TextureCoordinates at = c.coordinates(board.mapping);
    return 0.5f - 0.5f * square_wave(at.st.x, filter_radius(at.dstdx.x, at.dstdy.x)) *
                      square_wave(at.st.y, filter_radius(at.dstdx.y, at.dstdy.y));
  }
  const auto [p, dx, dy] = c.solid();
  float product = 1;
  for (int k = 0; k < 3; ++k) product *= square_wave(p[k], filter_radius(dx[k], dy[k]));
  return 0.5f - 0.5f * product;
}

Rgb lerp_of(const TextureContext& c, float w, const TextureOperand& a, const TextureOperand& b) {
  if (w == 0) return c(a);
  if (w == 1) return c(b);
  return (1 - w) * c(a) + w * c(b);
}

bool inside_dot(const Point2& st) {
  constexpr float kRadius = 0.35f, kMaxShift = 0.5f - kRadius;
  const Point2 cell = glm::floor(st + 0.5f);
  if (!(noise(cell.x + 0.5f, cell.y + 0.5f) > 0)) return false;
  const Point2 center =
      cell + kMaxShift * Vector2(noise(cell.x + 1.5f, cell.y + 2.8f), noise(cell.x + 4.5f, cell.y + 9.8f));
  const Vector2 d = st - center;
  return glm::dot(d, d) < kRadius * kRadius;
}

// pbrt's colours of marble: six cubic Bezier curves over nine points. NaN stays NaN.
Rgb marble_colour(float t) {
  static const Rgb points[] = {{.58f, .58f, .6f}, {.58f, .58f, .6f}, {.58f, .58f, .6f},
                               {.5f, .5f, .5f},   {.6f, .59f, .58f}, {.58f, .58f, .6f},
                               {.58f, .58f, .6f}, {.2f, .2f, .33f},  {.58f, .58f, .6f}};
  constexpr int kCurves = 6;
  const int first = t > 0 ? std::min(int(t * kCurves), kCurves - 1) : 0;  // zero for NaN, too
  const float u = t * kCurves - float(first), v = 1 - u;
  const Rgb* b = points + first;
  return 1.5f * (v * v * v * b[0] + 3 * v * v * u * b[1] + 3 * v * u * u * b[2] + u * u * u * b[3]);
}

}  // namespace

Rgb TextureContext::operator()(const TextureOperand& operand) const {
  return operand.texture == kNoIndex ? operand.value : set.evaluate(operand.texture, x);
}

Rgb MixTexture::evaluate(const TextureContext& c) const {
  return lerp_of(c, c(amount).x, tex1, tex2);
}

Rgb DirectionMixTexture::evaluate(const TextureContext& c) const {
  return lerp_of(c, abs_dot(c.x.n, dir), tex2, tex1);
}

Rgb CheckerboardTexture::evaluate(const TextureContext& c) const {
  return lerp_of(c, checkerboard_weight(*this, c), tex1, tex2);
}

Rgb DotsTexture::evaluate(const TextureContext& c) const {
  return c(inside_dot(c.coordinates(mapping).st) ? in_dots : between_dots);
}

Rgb BilerpTexture::evaluate(const TextureContext& c) const {
  const Point2 st = c.coordinates(mapping).st;
  return (1 - st.x) * ((1 - st.y) * v00 + st.y * v01) + st.x * ((1 - st.y) * v10 + st.y * v11);
}

Rgb ImageTexture::evaluate(const TextureContext& c) const {
  const TextureCoordinates at = c.coordinates(mapping);
  const auto down = [](const Vector2& v) { return Vector2(v.x, -v.y); };
  Rgb value =
      scale * c.set.images().lookup(image, sampling, {at.st.x, 1 - at.st.y}, down(at.dstdx), down(at.dstdy));
  if (grey) value = Rgb(value.x);
  return glm::max(invert ? Rgb(1) - value : value, Rgb(0));
}

Rgb FbmTexture::evaluate(const TextureContext& c) const {
  const auto [p, dx, dy] = c.solid();
  return Rgb(fbm(p, dx, dy, octaves));
}

Rgb WrinkledTexture::evaluate(const TextureContext& c) const {
  const auto [p, dx, dy] = c.solid();
  return Rgb(turbulence(p, dx, dy, octaves));
}

Rgb WindyTexture::evaluate(const TextureContext& c) const {
  const auto [p, dx, dy] = c.solid();
  const float strength = fbm(0.1f * p, 0.1f * dx, 0.1f * dy, {0.5f, 3});
  return Rgb(std::abs(strength) * fbm(p, dx, dy, {0.5f, 6}));
}

Rgb MarbleTexture::evaluate(const TextureContext& c) const {
  const auto [p, dx, dy] = c.solid();
  const float at = scale * p.y + variation * fbm(scale * p, scale * dx, scale * dy, octaves);
  return marble_colour(0.5f + 0.5f * std::sin(at));
}

uint32_t TextureSet::add(Texture texture, const Transform& to_world) {
  nodes_.push_back({std::move(texture), to_world});
  return static_cast<uint32_t>(nodes_.size() - 1);
}

Rgb TextureSet::evaluate(uint32_t texture, const TexturePoint& x) const {
  const Node& node = nodes_[texture];
  const TextureContext context{*this, node.to_world, x};
  return std::visit([&](const auto& t) { return t.evaluate(context); }, node.texture);
}

}  // namespace kaustik
