// Tests the directions towards media that emit.

#include "core/medium/emissive_bodies.h"

#include <gtest/gtest.h>

#include "tests/core/support/chi_square.h"

namespace kaustik {
namespace {

using test::Random;

const Medium kGlowing{Rgb(1), Rgb(0), 0, nullptr, Rgb(1, 2, 3)};

Bounds3 box_at(const Point3& center, float half) {
  Bounds3 box;
  box.add(center - Vector3(half));
  box.add(center + Vector3(half));
  return box;
}

test::SquareCase directions_from(const std::string& name, const Point3& p, const EmissiveBodies& bodies) {
  test::SquareCase c;
  c.name = name;
  c.subdivisions = 400;  // the density jumps at the outlines of the cones
  c.sample = [=](Random& random, Point2* at) {
    const float u = random.uniform();
    const EmissiveBodies::Sample s = bodies.sample(p, u, random.uniform_2d());
    EXPECT_EQ(s.pdf, bodies.pdf(p, s.wi));
    EXPECT_GT(s.pdf, 0);
    *at = test::direction_to_square(s.wi, -1);
    return true;
  };
  c.density = [=](double x, double y) {
    const double z = 2 * x - 1, r = std::sqrt(1 - z * z), phi = 2 * std::numbers::pi * y;
    const Vector3 w(glm::dvec3(r * std::cos(phi), r * std::sin(phi), z));
    return double(bodies.pdf(p, w)) * test::square_solid_angle(-1);
  };
  return c;
}

TEST(EmissiveBodies, DirectionsFollowTheirDensity) {
  EmissiveBodies one, several;
  one.add(box_at({1, 2, 0}, 0.5f), kGlowing);
  several.add(box_at({1, 2, 0}, 0.5f), kGlowing);
  several.add(box_at({-3, 0, 1}, 0.4f), kGlowing);
  several.add(box_at({1, 2, 1}, 0.7f), kGlowing);  // its cone overlaps that of the first
  test::expect_all_accepted(
      {directions_from("outside", {0, 0, 0}, one), directions_from("inside", {1.2f, 2, 0.1f}, one),
       directions_from("several", {0, 0, 0}, several)},
      50'000, 2e-3);
}

// The cone holds the sphere around the box, and no more: 1 - cos for sin = r / d.
TEST(EmissiveBodies, TheirConesHoldTheirSpheres) {
  EmissiveBodies bodies;
  bodies.add(box_at({0, 0, 5}, 1), kGlowing);
  const double sine = std::sqrt(3.0) / 5, cosine = std::sqrt(1 - sine * sine);
  EXPECT_NEAR(bodies.pdf({0, 0, 0}, {0, 0, 1}), 1 / (2 * std::numbers::pi * (1 - cosine)), 1e-5);
  for (const double turn : {0.999, 1.001}) {
    const double angle = turn * std::asin(sine);
    const Vector3 w(glm::dvec3(std::sin(angle), 0, std::cos(angle)));
    EXPECT_EQ(bodies.pdf({0, 0, 0}, w) > 0, turn < 1);
  }
}

TEST(EmissiveBodies, OnlyTheBrightestAreKept) {
  EmissiveBodies bodies;
  for (size_t i = 0; i < EmissiveBodies::kMost; ++i) bodies.add(box_at({100, 10 * float(i), 0}, 1), kGlowing);
  Medium dim = kGlowing;
  dim.Le = Rgb(1e-3f);
  bodies.add(box_at({0, 0, 10}, 1), dim);
  EXPECT_EQ(bodies.pdf({0, 0, 0}, {0, 0, 1}), 0);
  bodies.add(box_at({0, 0, -10}, 2), kGlowing);
  EXPECT_GT(bodies.pdf({0, 0, 0}, {0, 0, -1}), 0);
}

TEST(EmissiveBodies, WhatDoesNotEmitIsNone) {
  EmissiveBodies bodies;
  bodies.add(box_at({0, 0, 0}, 1), Medium{Rgb(1), Rgb(2)});
  bodies.add(Bounds3(), kGlowing);
  EXPECT_TRUE(bodies.empty());
  EXPECT_EQ(bodies.sample({0, 0, 0}, 0.5f, {0.5f, 0.5f}).pdf, 0);
}

}  // namespace
}  // namespace kaustik
