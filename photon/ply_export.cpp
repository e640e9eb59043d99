// Binary PLY of photons.

#include "photon/ply_export.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "core/pending_file.h"

namespace kaustik::photon {

namespace {

static_assert(std::endian::native == std::endian::little, "vertices are written as they lie in memory");

// x y z nx ny nz, then red green blue kind.
inline constexpr size_t kVertexBytes = 6 * sizeof(float) + 4;

void write_header(std::ofstream& out, uint64_t vertices) {
  out << "ply\nformat binary_little_endian 1.0\ncomment photons; kind:";
  for (size_t kind = 0; kind < size_t(kPhotonKinds); ++kind)
    out << ' ' << kind << ' ' << kPhotonKindNames[kind];
  out << "\nelement vertex " << vertices << '\n';
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) out << "property float " << name << '\n';
  for (const char* name : {"red", "green", "blue", "kind"}) out << "property uchar " << name << '\n';
  out << "end_header\n";
}

float mean_luminance(const PhotonBuffer& buffer) {
  double sum = 0;
  for (const PhotonRecord& record : buffer.records)
    sum += double(luminance(unpack(record, buffer.flux_unit).flux));
  return buffer.records.empty() ? 0 : float(sum / double(buffer.records.size()));
}

void write_vertices(std::ofstream& out, const PlyPhotons& photons) {
  constexpr size_t kBlock = 1 << 16;
  const PhotonBuffer& buffer = *photons.buffer;
  const float mean = mean_luminance(buffer);
  std::vector<char> bytes;
  for (size_t begin = 0; begin < buffer.records.size(); begin += kBlock) {
    const size_t end = std::min(buffer.records.size(), begin + kBlock);
    bytes.resize((end - begin) * kVertexBytes);
    char* at = bytes.data();
    for (size_t i = begin; i < end; ++i, at += kVertexBytes) {
      const Photon photon = unpack(buffer.records[i], buffer.flux_unit);
      const float numbers[] = {photon.p.x, photon.p.y, photon.p.z, photon.n.x, photon.n.y, photon.n.z};
      const glm::u8vec3 c = photon_colour(photons.kind, photon.flux, mean);
      const uint8_t tail[] = {c.x, c.y, c.z, uint8_t(photons.kind)};
      std::memcpy(at, numbers, sizeof(numbers));
      std::memcpy(at + sizeof(numbers), tail, sizeof(tail));
    }
    out.write(bytes.data(), std::streamsize(bytes.size()));
  }
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw std::runtime_error("cannot write " + path.string() + ": " + reason);
}

}  // namespace

glm::u8vec3 photon_colour(PhotonKind kind, const Rgb& flux, float mean_flux) {
  if (kind == PhotonKind::kShadow) return kShadowColour;
  glm::u8vec3 colour(0);
  for (int c = 0; c < 3; ++c) {
    // Reinhard's curve, the mean at one half, with a display gamma of 2.2.
    const float v = mean_flux > 0 ? flux[c] / mean_flux : 0;
    colour[c] = uint8_t(std::lround(255 * std::pow(v / (1 + v), 1 / 2.2f)));
  }
  return colour;
}

void write_photons_ply(const std::filesystem::path& path, std::span<const PlyPhotons> photons) {
  uint64_t vertices = 0;
  for (const PlyPhotons& part : photons) vertices += part.buffer->records.size();
  PendingFile file(path, unique_temporary_name(path));
  std::ofstream out(file.temporary(), std::ios::binary | std::ios::trunc);
  if (!out) fail(path, std::strerror(errno));
  write_header(out, vertices);
  for (const PlyPhotons& part : photons) write_vertices(out, part);
  out.close();
  if (!out) fail(path, std::strerror(errno));
  if (const std::string error = file.commit(); !error.empty()) fail(path, error);
}

}  // namespace kaustik::photon
