// kaustik convert: writes a scene of any readable format as pbrt-v4 text, with its meshes and images beside
// it.

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/convert/ply_bytes.h"
#include "apps/convert/scene_folder.h"
#include "apps/convert/scene_text.h"
#include "apps/import/common/scene_files.h"
#include "apps/session/files/collisions.h"
#include "apps/session/files/output_files.h"
#include "apps/session/files/scene_loading.h"

namespace kaustik::app {

namespace {

namespace fs = std::filesystem;

struct ConvertOptions {
  std::string scene, output;
  SettingOverrides overrides;
};

// Meshes with at most this many corners stay in the text, where they are easier to edit.
constexpr size_t kFewCorners = 36;

void check_names(const ConvertOptions& options) {
  if (!options.output.ends_with(".pbrt"))
    throw ExitError(kBadCommandLine, fmt::format("{}: the output must end in .pbrt", options.output));
  check_writable(options.output);
  std::error_code ignored;
  if (fs::equivalent(options.scene, options.output, ignored))
    throw ExitError(kBadCommandLine,
                    fmt::format("{} is the input itself: choose another output", options.output));
}

std::string text_of(const ConvertOptions& options, const SceneDescription& scene, const SourceFiles& files,
                    SceneFolder& folder) {
  SceneTextFiles beside;
  beside.file = [&](const std::string& name, const SourceLocation& where) {
    const fs::path naming(where.valid() ? files.name(where.file) : options.scene);
    const ReadableFile file = pbrt::find_named_file(files.root(), name, naming, options.scene);
    return file.exists() ? folder.copy(file) : name;
  };
  beside.mesh = [&](const ShapeDescription& shape) {
    const Parameter* indices = shape.find("indices");
    const bool small = !indices || indices->numbers.size() <= kFewCorners;
    const auto bytes = small ? std::nullopt : ply_bytes(shape);
    return bytes ? folder.add_mesh(*bytes) : std::string();
  };
  return fmt::format("# Converted by kaustik from {}.\n", fs::path(options.scene).filename().string()) +
         scene_text(scene, beside);
}

// Logs materials and integrators that pbrt does not know.
void note_our_own(const SceneDescription& scene, const Console& console) {
  std::set<std::string> own;
  for (const MaterialDescription& m : scene.materials) {
    if (m.type == "mirror" || m.type == "orennayar") own.insert(fmt::format("material \"{}\"", m.type));
  }
  for (const TextureDescription& t : scene.textures) {
    if (t.type == "vertexcolor") own.insert("texture \"vertexcolor\"");
    for (const char* name : {"ushear", "vshear", "vwrap"})
      if (t.find(name)) own.insert(fmt::format("`{}` of textures", name));
    const Parameter* wrap = t.find("wrap");
    if (wrap && wrap->strings == std::vector<std::string>{"mirror"}) own.insert("wrap \"mirror\"");
  }
  if (scene.integrator && scene.integrator->type == "photonmap") own.insert("integrator \"photonmap\"");
  if (!own.empty())
    console.note(fmt::format("pbrt does not know these extensions of kaustik: {}", fmt::join(own, ", ")));
}

int run_convert(const ConvertOptions& options, const Console& console) {
  check_names(options);
  Diagnostics diagnostics;
  const auto loaded = pbrt::load_scene(options.scene, diagnostics, options.overrides.alone().import_options);
  console.err << diagnostics.format_all();
  if (!loaded)
    throw ExitError(kBadScene,
                    fmt::format("{}: {}", options.scene, counted(diagnostics.error_count(), "error")));
  std::vector<NamedFile> inputs;
  for (const std::string& file : loaded->files) inputs.push_back({"the scene's file", file});
  check_collisions({{"OUTPUT", options.output}}, inputs);
  SceneFolder folder(options.output);
  const std::string text = text_of(options, loaded->description, diagnostics.files, folder);
  folder.commit(text);
  for (const std::string& note : loaded->description.notes) console.note(note);
  note_our_own(loaded->description, console);
  console.note(fmt::format("wrote {}: {}", options.output, scene_summary(loaded->scene)));
  if (folder.meshes() + folder.copies() > 0)
    console.note(fmt::format("  its folder {} holds {} and {}", folder.folder().string(),
                             counted(folder.meshes(), "mesh file"), counted(folder.copies(), "copied file")));
  return kDone;
}

}  // namespace

Command make_convert_command() {
  Command command("convert", "Write a scene (glTF, OBJ, PLY, STL, pbrt) as pbrt-v4 text");
  const auto options = std::make_shared<ConvertOptions>();
  command.add_argument("SCENE", options->scene, "Scene file: .gltf, .glb, .obj, .ply, .stl or .pbrt");
  command.add_argument("OUTPUT", options->output,
                       "Scene to write, NAME.pbrt; meshes and images go to the folder NAME-files beside it");
  command.add_quiet("Suppress the log, but not warnings and errors");
  add_setting_options(command, options->overrides, SettingsCommand::kConvert);
  command.run = [options](const Console& console) { return run_convert(*options, console); };
  return command;
}

}  // namespace kaustik::app
