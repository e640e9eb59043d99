#pragma once
// Edits of a material's parameters that several of pbrt-v3's materials need.

#include <initializer_list>
#include <string_view>
#include <vector>

#include "core/scene/description/description.h"

namespace kaustik::pbrt::v3 {

void erase(Directive& d, std::initializer_list<std::string_view> names);
// Does nothing if the old name is absent or the new one is taken.
void rename(Directive& d, std::string_view from, std::string_view to);
Parameter& add(Directive& d, ParameterType type, std::string_view name, std::vector<double> numbers);
void set_default(Directive& d, std::string_view name, double value);
// The value of a parameter with one number; `otherwise` when it is absent or a texture.
double number(const Directive& d, std::string_view name, double otherwise);
// Whether all of a parameter's numbers are zero; `otherwise` when it is absent.
bool is_black(const Directive& d, std::string_view name, bool otherwise);
// Multiplies a colour of numbers and limits it to [0, 1]. Textures and spectra stay as they are.
void scale_colour(Directive& d, std::string_view name, double factor);
// Converts numeric roughness to GGX widths. Roughness textures stay and are mapped as in v4. `otherwise`: the
// material's default roughness in v3. `smooth_at_zero`: roughness 0 means a smooth surface.
void keep_width(Directive& d, double otherwise, bool smooth_at_zero = false);
// Replaces whatever roughness there is by a smooth surface.
void make_smooth(Directive& d);
// Makes a diffuse surface of `Kd` under a coat of v4's kind. The numbers are v3's defaults.
void make_coated(Directive& d, double diffuse, double roughness);

}  // namespace kaustik::pbrt::v3
