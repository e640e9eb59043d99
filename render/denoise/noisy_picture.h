#pragma once
// What a denoiser needs of a picture, from the layers of an EXR file: one that kaustik wrote with
// `--aov denoising`, or one of another renderer.
//
// Layers of other renderers go by the names that Blender (`ViewLayer.Noisy Image.R`, `ViewLayer.Denoising
// Albedo.R`, ...), pbrt (`Albedo.R`, `Ns.X`, ...) and Mitsuba's documentation (`albedo.R`, `nn.X`)
// give them. Such a file has no halves of samples. Its noise is estimated from what each pixel differs by
// from the affine function of its neighbours, as the median over 7 x 7 pixels, which edges hardly change
// (Immerkaer 1996; Donoho and Johnstone 1994); and two halves are made of the picture by adding and
// subtracting that much, which have uncorrelated errors (Pang and others 2021, "Recorrupted-to-Recorrupted").

#include <string>
#include <vector>

#include "render/film/halves.h"
#include "render/picture/exr_file.h"

namespace kaustik::render {

struct NoisyPicture {
  Film film;  // its radiance() is the picture before denoising
  HalfFilm halves;
  bool measured = false;             // the halves are of samples
  std::vector<std::string> missing;  // features that the file does not have
};

// Throws std::runtime_error, without the file's name, if there is no picture in it.
NoisyPicture noisy_picture(const ExrChannels& file);

}  // namespace kaustik::render
