#include "photon/estimate/shadow_classifier.h"

#include <gtest/gtest.h>

#include "tests/photon/support/photon_sets.h"

namespace kaustik::photon {
namespace {

// A floor over the unit square: lit where x < lit_until, in shadow elsewhere.
struct Floor {
  PhotonMap direct, shadow;
};

Floor make_floor(int photons, float lit_until) {
  PhotonMaker make(20);
  std::vector<Photon> lit, dark;
  for (int i = 0; i < photons; ++i) {
    const Photon photon = make.at({make.uniform(), make.uniform(), 0}, {0, 0, 1}, 0);
    (photon.p.x < lit_until ? lit : dark).push_back(photon);
  }
  MapSettings settings;
  settings.bounds = Bounds3{Point3(0), Point3(1, 1, 0.5f)};
  return {PhotonMap::build(make_buffer(lit), settings), PhotonMap::build(make_buffer(dark), settings)};
}

constexpr LectureSettings kSettings{0.01f, 64, 8};

// The lecture's conditions, counted photon by photon in the cell of depth `depth` around p.
struct CellCheck {
  uint64_t lit = 0, dark = 0;
  bool keeps = false;
};
CellCheck check_cell(const Floor& floor, const Point3& p, int depth) {
  CellCheck check;
  const MortonCube& cube = floor.direct.cube();
  const auto prefix = [&](const Point3& q) {
    return morton_key(cube.cell(q)) >> (3 * (kMortonBits - depth));
  };
  for (uint64_t i = 0; i < floor.direct.size(); ++i)
    check.lit += prefix(floor.direct.photon(i).p) == prefix(p);
  for (uint64_t i = 0; i < floor.shadow.size(); ++i)
    check.dark += prefix(floor.shadow.photon(i).p) == prefix(p);
  check.keeps = floor.direct.octree().keeps_from_faces(p, kSettings.radius, depth);
  return check;
}

TEST(LectureLookup, ObeysTheThreeConditions) {
  const Floor floor = make_floor(10000, 0.6f);
  PhotonMaker make(21);
  std::array<int, 5> seen{};
  for (int i = 0; i < 200; ++i) {
    const Point3 p(make.uniform(), make.uniform(), 0);
    const LectureAnswer answer = lecture_lookup(floor.direct, floor.shadow, p, kSettings);
    ++seen[size_t(answer.outcome)];
    const CellCheck cell = check_cell(floor, p, answer.depth);
    EXPECT_EQ(answer.photons(), cell.lit);
    if (answer.use_photons()) {
      EXPECT_GT(cell.lit, kSettings.min_photons);
      EXPECT_EQ(cell.dark, 0u);
      EXPECT_TRUE(cell.keeps);
      EXPECT_EQ(answer.outcome == LectureOutcome::kClimbed, answer.climbed > 0);
    } else if (answer.outcome == LectureOutcome::kShadow) {
      EXPECT_GT(cell.dark, 0u);
    }
    // A fallback means that no ancestor cell can answer either.
    for (int depth = answer.depth; !answer.use_photons() && depth >= 0; --depth) {
      const CellCheck parent = check_cell(floor, p, depth);
      EXPECT_FALSE(parent.keeps && parent.dark == 0 && parent.lit > kSettings.min_photons);
    }
  }
  EXPECT_GT(seen[size_t(LectureOutcome::kPhotons)], 0);
  EXPECT_GT(seen[size_t(LectureOutcome::kClimbed)], 0);
  EXPECT_GT(seen[size_t(LectureOutcome::kShadow)], 0);
  EXPECT_GT(seen[size_t(LectureOutcome::kFace)], 0);
}

TEST(LectureLookup, FallsBackWhereThereAreFewPhotons) {
  const Floor floor = make_floor(5, 1);
  const LectureAnswer answer = lecture_lookup(floor.direct, floor.shadow, {0.5f, 0.5f, 0}, kSettings);
  EXPECT_EQ(answer.outcome, LectureOutcome::kFew);
  EXPECT_FALSE(answer.use_photons());
}

TEST(LectureLookup, EmptyMapsFallBack) {
  const Floor floor = make_floor(0, 1);
  EXPECT_EQ(lecture_lookup(floor.direct, floor.shadow, Point3(0), kSettings).outcome, LectureOutcome::kFew);
}

TEST(LectureLookup, NeverAnswersFromPhotonsInFullShadow) {
  const Floor floor = make_floor(10000, 0.5f);
  for (int i = 0; i < 100; ++i) {
    const Point3 p(0.52f + 0.0048f * float(i), 0.3f, 0);
    EXPECT_FALSE(lecture_lookup(floor.direct, floor.shadow, p, kSettings).use_photons()) << p.x;
  }
}

TEST(LectureLookup, RefusesMapsOfDifferentCubes) {
  const Floor floor = make_floor(100, 1);
  MapSettings other;
  other.bounds = Bounds3{Point3(-1), Point3(3)};
  const PhotonMap shadow = PhotonMap::build({}, other);
  EXPECT_THROW(lecture_lookup(floor.direct, shadow, Point3(0), kSettings), std::invalid_argument);
}

}  // namespace
}  // namespace kaustik::photon
