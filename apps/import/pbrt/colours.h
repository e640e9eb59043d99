#pragma once
// Converts spectra, blackbodies and colours of other colour spaces to linear Rec. 709: later stages know only
// "rgb".

#include <functional>
#include <optional>

#include "apps/import/common/scene_files.h"
#include "core/diagnostics/diagnostics.h"
#include "core/scene/schema/schema.h"
#include "core/spectrum/colour_space.h"
#include "core/spectrum/spectrum.h"

namespace kaustik::pbrt {

class ColourReducer {
 public:
  ColourReducer(TextOpener open, Diagnostics& diagnostics)
      : open_(std::move(open)), diagnostics_(diagnostics) {}

  // Converts the colour parameters of a directive to linear Rec. 709. "spectrum" and "blackbody" become rgb
  // where the type takes rgb; where it takes an index of refraction, a float, and the coefficients or samples
  // of its dispersion. Spectra of lights are scaled to luminance 1, as in pbrt-v4; spectra of surfaces become
  // their colour under D65. Named spectra are pbrt's (core/spectrum/named_spectra.h) or files of wavelengths
  // and values. "rgb" is converted from `space`. Negative components of colours outside the gamut become
  // zero. Invalid parameters are removed with an error; parameters that the type does not take are left for
  // the schema check to report. `directive`: "Material", ...
  void reduce(std::string_view directive, const ColourSpace& space, Directive& out);

 private:
  void reduce_colour(Parameter& p, const ParameterSpec& spec, const Spectrum& s, bool light);
  // Makes p the number at the d line. disperses: whether the type renders dispersion; then returns the
  // parameter that tells the indices at all wavelengths, if they vary.
  std::optional<Parameter> reduce_index(Parameter& p, const Spectrum& s, bool disperses);
  void add_dispersion(Parameter dispersion, Directive& out);
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
