#pragma once
// Spectra, blackbodies and colours of other spaces, reduced to linear Rec. 709: what comes after the importer
// knows "rgb" only.

#include <functional>
#include <optional>

#include "core/diagnostics/diagnostics.h"
#include "core/scene/schema/schema.h"
#include "core/spectrum/colour_space.h"
#include "core/spectrum/spectrum.h"

namespace kaustik::pbrt {

// The id of a text file that a parameter names; nothing with the reason in `error`.
using TextOpener = std::function<std::optional<uint32_t>(const std::string& name, std::string& error)>;

class ColourReducer {
 public:
  ColourReducer(TextOpener open, Diagnostics& diagnostics)
      : open_(std::move(open)), diagnostics_(diagnostics) {}

  // Makes rgb of "spectrum" and "blackbody" parameters where the directive's type takes rgb, and a float of a
  // spectrum where it takes an index of refraction. Spectra of lights have luminance 1, as in pbrt-v4; those
  // of surfaces the colour that they show under D65. Names are pbrt's (core/spectrum/named_spectra.h) or
  // files of wavelengths and values. "rgb" is taken from the colour space to ours. Colours outside of our
  // gamut are cut off at zero. Parameters that are wrong are removed, with an error; those that the type does
  // not take are left for the schema to complain about. directive: "Material", ...
  void reduce(std::string_view directive, const ColourSpace& space, Directive& out);

 private:
  void reduce_spectrum(Parameter& p, const ParameterSpec& spec, const Spectrum& s, bool light);
  std::optional<Spectrum> spectrum_of(const Parameter& p);
  std::optional<Spectrum> from_pairs(const Parameter& p);
  std::optional<Spectrum> from_name(const Parameter& p);
  std::optional<Spectrum> from_file(const Parameter& p, uint32_t file);
  std::optional<Spectrum> from_samples(const std::vector<double>& pairs, const SourceLocation& where,
                                       const std::function<SourceLocation(size_t)>& place);

  TextOpener open_;
  Diagnostics& diagnostics_;
  bool warned_of_dispersion_ = false;
};

}  // namespace kaustik::pbrt
