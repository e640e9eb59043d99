// Writes photons as binary PLY.

#include "photon/record/ply_export.h"

#include <array>
#include <bit>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "core/files/pending_file.h"

namespace kaustik::photon {

namespace {

static_assert(std::endian::native == std::endian::little, "vertices are written as they lie in memory");

// Bytes of a vertex: x y z nx ny nz, then red green blue kind.
template <class Coordinate>
constexpr size_t kVertexBytes = 3 * sizeof(Coordinate) + 3 * sizeof(float) + 4;

std::string header(uint64_t vertices, std::string_view coordinate) {
  std::ostringstream out;
  out << "ply\nformat binary_little_endian 1.0\ncomment photons; kind:";
  for (size_t kind = 0; kind < size_t(kPhotonKinds); ++kind)
    out << ' ' << kind << ' ' << kPhotonKindNames[kind];
  out << "\nelement vertex " << vertices << '\n';
  for (const char* name : {"x", "y", "z"}) out << "property " << coordinate << ' ' << name << '\n';
  for (const char* name : {"nx", "ny", "nz"}) out << "property float " << name << '\n';
  for (const char* name : {"red", "green", "blue", "kind"}) out << "property uchar " << name << '\n';
  out << "end_header\n";
  return out.str();
}

float mean_luminance(const PhotonBuffer& buffer) {
  double sum = 0;
  for (size_t i = 0; i < buffer.records.size(); ++i) sum += double(luminance(buffer.photon(i).flux));
  return buffer.records.empty() ? 0 : float(sum / double(buffer.records.size()));
}

template <class Coordinate>
void write_vertices(PendingFile& out, const PlyPhotons& photons, const glm::dvec3& origin) {
  constexpr size_t kBlock = 1 << 16, kBytes = kVertexBytes<Coordinate>;
  const PhotonBuffer& buffer = *photons.buffer;
  const float mean = mean_luminance(buffer);
  std::vector<char> bytes;
  for (size_t begin = 0; begin < buffer.records.size(); begin += kBlock) {
    const size_t end = std::min(buffer.records.size(), begin + kBlock);
    bytes.resize((end - begin) * kBytes);
    char* at = bytes.data();
    for (size_t i = begin; i < end; ++i, at += kBytes) {
      const Photon photon = buffer.photon(i);
      glm::vec<3, Coordinate> p(photon.p);
      if constexpr (std::is_same_v<Coordinate, double>) p += origin;
      const glm::u8vec3 c = photon_colour(photons.kind, photon.flux, mean);
      const uint8_t tail[] = {c.x, c.y, c.z, uint8_t(photons.kind)};
      std::memcpy(at, &p, sizeof(p));
      std::memcpy(at + sizeof(p), &photon.n, sizeof(photon.n));
      std::memcpy(at + sizeof(p) + sizeof(photon.n), tail, sizeof(tail));
    }
    out.write(bytes.data(), bytes.size());
  }
}

}  // namespace

glm::u8vec3 photon_colour(PhotonKind kind, const Rgb& flux, float mean_flux) {
  if (kind == PhotonKind::kShadow) return kShadowColour;
  glm::u8vec3 colour(0);
  for (int c = 0; c < 3; ++c) {
    // Reinhard's curve, which maps the mean to one half, followed by a display gamma of 2.2.
    const float v = mean_flux > 0 ? std::max(flux[c], 0.0f) / mean_flux : 0;
    colour[c] = uint8_t(std::lround(255 * std::pow(v / (1 + v), 1 / 2.2f)));
  }
  return colour;
}

void write_photons_ply(const std::filesystem::path& path, std::span<const PlyPhotons> photons,
                       const glm::dvec3& origin) {
  uint64_t vertices = 0;
  for (const PlyPhotons& part : photons) vertices += part.buffer->records.size();
  const bool far = origin != glm::dvec3(0);
  try {
    PendingFile out(path);
    out.write(header(vertices, far ? "double" : "float"));
    for (const PlyPhotons& part : photons)
      far ? write_vertices<double>(out, part, origin) : write_vertices<float>(out, part, origin);
    out.commit();
  } catch (const FileError& error) {
    throw std::runtime_error("cannot write " + path.string() + ": " + error.what());
  }
}

}  // namespace kaustik::photon
