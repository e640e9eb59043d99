#pragma once
// The materials of a description, by name.

#include <map>
#include <string>
#include <vector>

#include "core/scene/build/texture_table.h"

namespace kaustik {

class MaterialTable {
 public:
  static constexpr uint32_t kInterface = 0xfffffffeu;  // no surface: the shape is left out

  // Makes every material; reports invalid ones and names defined twice.
  MaterialTable(const SceneDescription& description, const TextureTable& textures, WarnedOnce& warned,
                DiagnosticList& diagnostics);

  // Index into materials(), or kInterface. Where a name is undefined, with a warning once per name, and where
  // no material was set, the result is pbrt's default: diffuse with reflectance 0.5.
  uint32_t resolve(const MaterialReference& reference, DiagnosticList& diagnostics);

  std::vector<Material>& materials() { return materials_; }
  std::vector<std::string>& names() { return names_; }

 private:
  const TextureTable& textures_;
  uint32_t add(Material made, std::string name);
  uint32_t make(const MaterialDescription& material, WarnedOnce& warned, DiagnosticList& diagnostics);
  uint32_t mix(const MaterialDescription& material, const TypeSpec& spec, DiagnosticList& diagnostics);
  Material make(const MaterialRow& row, const MaterialDescription& material, DiagnosticList& diagnostics);
  // The material without dispersion. eta: its index of refraction by wavelength, or null.
  Material make_of_one_colour(const MaterialRow& row, const MaterialDescription& material,
                              const Spectrum* eta, DiagnosticList& diagnostics);
  uint32_t default_material();

  std::vector<Material> materials_;
  std::vector<std::string> names_;
  std::vector<uint32_t> of_description_;
  std::map<std::string, uint32_t, std::less<>> by_name_;
  std::set<std::string, std::less<>> reported_;  // undefined names
  uint32_t default_ = kNoIndex;
};

}  // namespace kaustik
