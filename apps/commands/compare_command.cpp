// kaustik compare: measures how much a picture differs from a reference.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/session/files/collisions.h"
#include "apps/session/files/file_writer.h"
#include "apps/session/files/output_files.h"
#include "render/picture/compare.h"
#include "render/picture/image_io.h"

namespace kaustik::app {

namespace {

struct CompareOptions {
  std::string reference, image, heatmap;
  bool json = false;
  std::optional<float> max_relmse, mask_bright;
};

// JSON cannot represent infinity, the PSNR of equal pictures.
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

std::string as_json(const render::CompareResult& r, bool within_limit) {
  nlohmann::ordered_json out;
  out["rmse"] = r.rmse;
  out["relmse"] = r.relmse;
  out["relmse_of_blocks"] = blocks_json(r);
  out["psnr"] = number_or_null(r.psnr);
  out["max_difference"] = {
      {"value", r.max_difference}, {"x", r.max_x}, {"y", r.max_y}, {"channel", r.max_channel}};
  out["mean"] = r.mean_image;
  out["reference_mean"] = r.mean_reference;
  out["pixels"] = {{"compared", r.compared},
                   {"masked", r.masked},
                   {"not_finite", r.nan_image},
                   {"reference_not_finite", r.nan_reference}};
  out["within_limit"] = within_limit;
  return out.dump(2);
}

std::string as_text(const render::CompareResult& r) {
  std::string text = fmt::format(
      "RMSE            {:.6g}\nrelMSE          {:.6g}\nof blocks       {}\nPSNR            {:.2f} dB\n"
      "largest error   {:.6g} at x {} y {}, channel {}\nmean            {:.6g}, reference {:.6g}\n"
      "pixels          {} compared, {} masked",
      r.rmse, r.relmse, blocks_text(r), r.psnr, r.max_difference, r.max_x, r.max_y, "RGB"[r.max_channel % 3],
      r.mean_image, r.mean_reference, r.compared, r.masked);
  if (r.nan_image + r.nan_reference > 0) {
    text += fmt::format("\nnot finite      {} pixels of the image, {} of the reference", r.nan_image,
                        r.nan_reference);
  }
  return text;
}

// Compares the files, and writes the heat map. Throws ExitError (bad command line) for pictures that cannot
// be read or differ in size.
render::CompareResult compare_files(const CompareOptions& options, FileWriter& writer) {
  try {
    const render::Image reference = render::read_image(options.reference);
    const render::Image image = render::read_image(options.image);
    const render::CompareResult result =
        render::compare(reference, image, {.mask_bright = options.mask_bright});
    if (!options.heatmap.empty())
      writer.write(options.heatmap,
                   [&] { render::write_image(options.heatmap, render::heatmap(reference, image)); });
    return result;
  } catch (const render::ImageError& error) {
    throw ExitError(kBadCommandLine, error.what());
  } catch (const std::invalid_argument& error) {
    throw ExitError(kBadCommandLine, error.what());
  }
}

int run_compare(const CompareOptions& options, const Console& console) {
  if (!options.heatmap.empty()) check_image_output(options.heatmap);
  check_collisions({{"--heatmap", options.heatmap}},
                   {{"the reference", options.reference}, {"the picture", options.image}});
  Console quiet = console;
  quiet.quiet = true;  // compare has no log
  FileWriter writer(quiet);
  const render::CompareResult result = compare_files(options, writer);
  if (result.compared == 0) throw ExitError(kBadCommandLine, "there is no pixel to compare");
  // A pixel that is not finite in the image only counts as an infinite error.
  const bool finite = result.nan_image == 0;
  const bool within = !options.max_relmse || (finite && result.relmse <= *options.max_relmse);
  console.out << (options.json ? as_json(result, within) : as_text(result)) << '\n';
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
  command.add_argument("IMG", options->image, "Picture to compare, of the same size");
  command.add_flag("--json", options->json, "Print JSON");
  command.add_text("--heatmap", "FILE", options->heatmap,
                   "Write the relative squared error per pixel as a picture in false colours");
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
