// kaustik compare: measures how much a picture differs from a reference.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command_line/whole_numbers.h"
#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/session/files/collisions.h"
#include "apps/session/files/file_writer.h"
#include "apps/session/files/output_files.h"
#include "render/compare/common_part.h"
#include "render/compare/compare.h"
#include "render/compare/fireflies.h"
#include "render/compare/flip.h"
#include "render/picture/image_io.h"

namespace kaustik::app {

namespace {

struct CompareOptions {
  std::string reference, image, heatmap, flip_map;
  std::string layer;   // empty: the whole picture
  std::string blocks;  // the text of --blocks; empty: no deviations of blocks
  bool json = false, flip = false;
  std::optional<float> max_relmse, mask_bright, pixels_per_degree;

  bool asks_flip() const { return flip || !flip_map.empty() || pixels_per_degree; }
};

constexpr int kMostPixelsPerDegree = 1000;  // of a phone at arm's length there are some 100
constexpr int kLargestBlock = 65536;        // pixels a side, that of the largest picture

// JSON cannot represent infinity, such as the PSNR of equal pictures.
nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json blocks_json(const render::CompareResult& r) {
  nlohmann::ordered_json out;
  for (size_t i = 0; i < render::kBlockSides.size(); ++i)
    out[std::to_string(render::kBlockSides[i])] = r.relmse_of_blocks[i];
  return out;
}

// The relMSE of all sides but single pixels.
std::string blocks_text(const render::CompareResult& r) {
  std::string text;
  for (size_t i = 1; i < render::kBlockSides.size(); ++i)
    text += fmt::format("{0}{1:.6g} ({2} x {2})", i > 1 ? ", " : "", r.relmse_of_blocks[i],
                        render::kBlockSides[i]);
  return text;
}

// What one call finds.
struct Comparison {
  render::CompareResult result;
  render::Fireflies fireflies;
  std::string doubt;                              // why the numbers may mislead; empty = they do not
  std::optional<render::PixelRectangle> part;     // what is compared, where a picture is a crop
  int side = 0;                                   // of --blocks; 0 without it
  std::optional<render::BlockDeviations> blocks;  // of --blocks
  std::optional<render::Flip> flip;
};

nlohmann::ordered_json deviations_json(const render::BlockDeviations& b, int side) {
  return {{"side", side},
          {"count", b.blocks},
          {"mean", number_or_null(b.mean)},
          {"median", number_or_null(b.median)},
          {"quantile_95", number_or_null(b.quantile95)},
          {"largest",
           {{"value", number_or_null(b.largest)},
            {"x", b.x},
            {"y", b.y},
            {"mean", b.image},
            {"reference_mean", b.reference}}}};
}

nlohmann::ordered_json flip_json(const render::Flip& flip) {
  nlohmann::ordered_json exposures;
  if (const auto& e = flip.exposures)
    exposures = {{"start", e->start}, {"stop", e->stop}, {"count", e->count}};
  return {{"mean", flip.mean}, {"exposures", exposures}};
}

std::string flip_text(const render::Flip& flip) {
  std::string text = fmt::format("\nFLIP            {:.6g}", flip.mean);
  if (const auto& e = flip.exposures)
    text += e->count == 1 ? fmt::format(" at {:.3g} stops", e->start)
                          : fmt::format(", the largest of {} exposures from {:.3g} to {:.3g} stops", e->count,
                                        e->start, e->stop);
  return text;
}

std::string as_json(const Comparison& found, const CompareOptions& options, bool within_limit) {
  const render::CompareResult& r = found.result;
  nlohmann::ordered_json out;
  if (!options.layer.empty()) out["layer"] = options.layer;
  if (const auto& p = found.part)
    out["part"] = {{"x", p->x}, {"y", p->y}, {"width", p->width}, {"height", p->height}};
  out["rmse"] = r.rmse;
  out["relmse"] = r.relmse;
  out["relmse_of_blocks"] = blocks_json(r);
  out["psnr"] = number_or_null(r.psnr);
  out["max_difference"] = {
      {"value", r.max_difference}, {"x", r.max_x}, {"y", r.max_y}, {"channel", r.max_channel}};
  out["mean"] = r.mean_image;
  out["reference_mean"] = r.mean_reference;
  out["mean_ratio"] = number_or_null(r.mean_image / r.mean_reference);
  const render::Fireflies& f = found.fireflies;
  out["fireflies"] = {{"count", f.count},
                      {"x", f.x},
                      {"y", f.y},
                      {"luminance", f.image},
                      {"reference_luminance", f.reference}};
  if (found.flip) out["flip"] = flip_json(*found.flip);
  if (found.blocks) out["block_deviations"] = deviations_json(*found.blocks, found.side);
  out["pixels"] = {{"compared", r.compared},
                   {"masked", r.masked},
                   {"not_finite", r.nan_image},
                   {"reference_not_finite", r.nan_reference}};
  out["within_limit"] = within_limit;
  return out.dump(2);
}

std::string deviations_text(const render::BlockDeviations& b, int side) {
  const std::string blocks = fmt::format("{0} x {0}", side);
  if (b.blocks == 0) return fmt::format("\n{:15} black in both pictures", blocks);
  return fmt::format(
      "\n{:15} |I / R - 1| of {} blocks: mean {:.3g} %, median {:.3g} %, 95 % quantile {:.3g} %,\n"
      "                largest {:.3g} % at x {} y {}: mean {:.6g}, reference {:.6g}",
      blocks, b.blocks, 100 * b.mean, 100 * b.median, 100 * b.quantile95, 100 * b.largest, b.x, b.y, b.image,
      b.reference);
}

std::string as_text(const Comparison& found, const CompareOptions& options) {
  const render::CompareResult& r = found.result;
  std::string text = options.layer.empty() ? "" : fmt::format("layer           {}\n", options.layer);
  if (const auto& p = found.part)
    text += fmt::format("part            x {} to {}, y {} to {} of the full picture\n", p->x,
                        p->x + p->width - 1, p->y, p->y + p->height - 1);
  text += fmt::format(
      "RMSE            {:.6g}\nrelMSE          {:.6g}\nof blocks       {}\nPSNR            {:.2f} dB\n"
      "largest error   {:.6g} at x {} y {}, channel {}\nmean            {:.6g}, reference {:.6g}",
      r.rmse, r.relmse, blocks_text(r), r.psnr, r.max_difference, r.max_x, r.max_y, "RGB"[r.max_channel % 3],
      r.mean_image, r.mean_reference);
  if (r.mean_reference != 0) text += fmt::format(", ratio {:.6g}", r.mean_image / r.mean_reference);
  text += fmt::format("\nfireflies       {}", found.fireflies.count);
  if (found.fireflies.count > 0)
    text += fmt::format(", the brightest at x {} y {}: luminance {:.6g}, reference {:.6g}", found.fireflies.x,
                        found.fireflies.y, found.fireflies.image, found.fireflies.reference);
  text += fmt::format("\npixels          {} compared, {} masked", r.compared, r.masked);
  if (r.nan_image + r.nan_reference > 0) {
    text += fmt::format("\nnot finite      {} pixels of the image, {} of the reference", r.nan_image,
                        r.nan_reference);
  }
  if (found.flip) text += flip_text(*found.flip);
  if (found.blocks) text += deviations_text(*found.blocks, found.side);
  return text;
}

std::string options_of(const render::ToneSettings& tone) {
  return fmt::format("--exposure {} --tonemap {}", tone.exposure, render::name_of(tone.tonemap));
}

// Why the comparison of pictures may mislead: they do not show radiance in the same way. Otherwise empty.
std::string doubt_about(const render::Image& reference, const render::Image& image) {
  const bool mixed = reference.for_display != image.for_display;
  const render::Image& shown = reference.for_display ? reference : image;
  if (mixed && shown.tone != render::ToneSettings{})
    return fmt::format(
        "one of the pictures is in an integer format, which holds what a screen shows{}: it is compared with "
        "radiance as if it had been written with {}",
        shown.tone ? fmt::format(" ({})", options_of(*shown.tone)) : "", options_of({}));
  if (!mixed && reference.tone && image.tone && *reference.tone != *image.tone)
    return fmt::format("the pictures show radiance differently: the reference by {}, the other one by {}",
                       options_of(*reference.tone), options_of(*image.tone));
  return {};
}

// The picture, or the layer of it that is asked for.
render::Image picture_of(const std::string& path, const CompareOptions& options) {
  return options.layer.empty() ? render::read_image(path) : render::read_layer(path, options.layer);
}

// The pictures of a comparison, of one size if that can be had.
struct Pictures {
  render::Image reference, image;
  std::optional<render::Image> whole_reference;  // where a layer is compared and bright pixels are left out
  std::optional<render::PixelRectangle> part{};  // to which pictures are cut
};

// Reads the files, and cuts a picture to the part of it that the other one shows.
Pictures read_pictures(const CompareOptions& options) {
  Pictures p{picture_of(options.reference, options), picture_of(options.image, options), {}};
  if (!options.layer.empty() && options.mask_bright)
    p.whole_reference = render::read_image(options.reference);
  p.part = render::common_part(p.reference, p.image);
  if (!p.part) return p;
  p.reference = render::cut_to(p.reference, *p.part);
  p.image = render::cut_to(p.image, *p.part);
  if (p.whole_reference) p.whole_reference = render::cut_to(*p.whole_reference, *p.part);
  return p;
}

// Lets places be those of the full picture.
void move_to_full_picture(Comparison& found) {
  const auto move = [&](int& x, int& y) { x += found.part->x, y += found.part->y; };
  move(found.result.max_x, found.result.max_y);
  if (found.fireflies.count > 0) move(found.fireflies.x, found.fireflies.y);
  if (found.blocks && found.blocks->blocks > 0) move(found.blocks->x, found.blocks->y);
}

// Pictures that were both read from files of integers are compared as a screen shows them, others as
// radiance.
render::Flip flip_of(const render::Image& reference, const render::Image& image,
                     const render::CompareOptions& compared, const CompareOptions& options) {
  render::FlipSettings settings;
  if (options.pixels_per_degree) settings.pixels_per_degree = double(*options.pixels_per_degree);
  if (!(settings.pixels_per_degree >= 1 && settings.pixels_per_degree <= kMostPixelsPerDegree))
    throw ExitError(kBadCommandLine,
                    fmt::format("--pixels-per-degree: expected a number from 1 to {}, got {}",
                                kMostPixelsPerDegree, settings.pixels_per_degree));
  return reference.for_display && image.for_display
             ? render::flip_of_display(reference, image, settings, compared)
             : render::flip_of_radiance(reference, image, settings, compared);
}

// Compares the files, and writes the heat maps. Throws ExitError (bad command line) for pictures that cannot
// be read, lack the layer or differ in size.
Comparison compare_files(const CompareOptions& options, FileWriter& writer) {
  const int side = options.blocks.empty() ? 0 : int(whole_number("--blocks", options.blocks, kLargestBlock));
  try {
    const Pictures pictures = read_pictures(options);
    const render::Image &reference = pictures.reference, &image = pictures.image;
    render::CompareOptions compared{.mask_bright = options.mask_bright};
    if (pictures.whole_reference) compared.mask_from = &*pictures.whole_reference;
    Comparison found{render::compare(reference, image, compared),
                     render::find_fireflies(reference, image, compared),
                     doubt_about(reference, image),
                     pictures.part,
                     side,
                     {},
                     {}};
    if (side > 0) found.blocks = render::compare_blocks(reference, image, side, compared);
    if (options.asks_flip()) found.flip = flip_of(reference, image, compared, options);
    if (!options.flip_map.empty())
      writer.write(options.flip_map, [&] {
        render::write_image(options.flip_map,
                            render::flip_colours(*found.flip, reference.width, reference.height));
      });
    if (!options.heatmap.empty())
      writer.write(options.heatmap,
                   [&] { render::write_image(options.heatmap, render::heatmap(reference, image)); });
    if (found.part) move_to_full_picture(found);
    return found;
  } catch (const render::ImageError& error) {
    throw ExitError(kBadCommandLine, error.what());
  } catch (const std::invalid_argument& error) {
    throw ExitError(kBadCommandLine, error.what());
  }
}

int run_compare(const CompareOptions& options, const Console& console) {
  for (const std::string& output : {options.heatmap, options.flip_map})
    if (!output.empty()) check_image_output(output);
  check_collisions({{"--heatmap", options.heatmap}, {"--flip-map", options.flip_map}},
                   {{"the reference", options.reference}, {"the picture", options.image}});
  Console quiet = console;
  quiet.quiet = true;  // compare has no log
  FileWriter writer(quiet);
  const Comparison found = compare_files(options, writer);
  if (!found.doubt.empty()) console.warning(found.doubt);
  const render::CompareResult& result = found.result;
  if (result.compared == 0) throw ExitError(kBadCommandLine, "there is no pixel to compare");
  // A pixel that is not finite in the image only counts as an infinite error.
  const bool finite = result.nan_image == 0;
  const bool within = !options.max_relmse || (finite && result.relmse <= *options.max_relmse);
  console.out << (options.json ? as_json(found, options, within) : as_text(found, options)) << '\n';
  if (!within) {
    console.error(finite ? fmt::format("relMSE {:.6g} is above {:.6g}", result.relmse, *options.max_relmse)
                         : fmt::format("{} pixels of the image are not finite", result.nan_image));
  }
  return writer.report() && within ? kDone : kFailed;
}

}  // namespace

Command make_compare_command() {
  Command command("compare", "Measure how much a picture differs from a reference");
  const auto options = std::make_shared<CompareOptions>();
  command.add_argument("REF", options->reference, "Reference picture");
  command.add_argument("IMG", options->image,
                       "Picture to compare, of the same size, or a crop of the other one as an EXR file");
  command.add_flag("--json", options->json, "Print JSON");
  command
      .add_text(
          "--layer", "NAME", options->layer,
          "Compare this layer of both pictures (EXR files; see `render --aov`) instead of the whole ones")
      .choices = choices_of(render::kLayerNames);
  command.add_text(
      "--blocks", "N", options->blocks,
      "Also print how far the means of blocks of N x N pixels are from those of the reference: mean, median, "
      "95 % quantile and largest of |I / R - 1|");
  command.add_text("--heatmap", "FILE", options->heatmap,
                   "Write the relative squared error per pixel as a picture in false colours");
  command.add_flag("--flip", options->flip,
                   "Also print FLIP, from 0 to 1: the mean of the differences that a person notices when the "
                   "pictures replace each other on a screen (Andersson and others 2020). For radiance, as "
                   "EXR files hold it, over all exposures that show something");
  command.add_text("--flip-map", "FILE", options->flip_map,
                   "Write FLIP per pixel as a picture in false colours");
  command.add_number("--pixels-per-degree", "X", options->pixels_per_degree,
                     "Pixels of the screen in a degree of view, for FLIP: 1 to 1000. Default: 67.02, of a "
                     "screen 0.7 m wide of "
                     "3840 pixels, seen from 0.7 m");
  command.add_number(
      "--max-relmse", "X", options->max_relmse,
      "Exit with code 1 if relMSE, the mean of (I - R)^2 / (R^2 + 0.01), is above X. Default: no limit");
  command.add_number(
      "--mask-bright", "L", options->mask_bright,
      "Ignore reference pixels brighter than L [W/(m^2 sr)] and 2 pixels around them, such as edges of "
      "lights. Default: ignore none");
  command.run = [options](const Console& console) { return run_compare(*options, console); };
  return command;
}

}  // namespace kaustik::app
