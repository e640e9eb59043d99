#include "apps/convert/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "apps/import/pbrt/transforms.h"
#include "core/scene/schema/schema.h"

namespace kaustik::app {
namespace {

constexpr std::string_view kFileParameters[] = {"filename", "normalmap", "emissionfilename", "lensfile"};

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    constexpr std::string_view kSpecial = "\"\\\n\t\r\b\f", kWritten = "\"\\ntrbf";
    const size_t special = kSpecial.find(c);
    if (special != kSpecial.npos) out += '\\';
    out += special == kSpecial.npos ? c : kWritten[special];
  }
  return out + '"';
}

class Writer {
 public:
  Writer(const SceneDescription& scene, const SceneTextFiles& files) : scene_(scene), files_(files) {}

  std::string write() {
    name_materials();
    for (const MediumDescription& medium : scene_.media) write_medium(medium);
    settings();
    line("WorldBegin");
    for (const LightDescription& light : scene_.lights) write_light(light);
    for (const TextureDescription& texture : scene_.textures) write_texture(texture);
    for (size_t i = 0; i < scene_.materials.size(); ++i) material(scene_.materials[i], names_[i]);
    for (const ObjectDescription& object : scene_.objects) write_object(object);
    for (const ShapeDescription& shape : scene_.shapes) write_shape(shape);
    for (const InstanceDescription& instance : scene_.instances) write_instance(instance);
    return std::move(out_);
  }

 private:
  void line(std::string_view text) {
    out_.append(indent_, ' ');
    out_ += text;
    out_ += '\n';
  }
  void begin(std::string_view text = "AttributeBegin") {
    line(text);
    indent_ += 2;
  }
  void end(std::string_view text = "AttributeEnd") {
    indent_ -= 2;
    line(text);
  }

  void name_materials() {
    std::set<std::string> taken;
    for (const MaterialDescription& m : scene_.materials) taken.insert(m.name);
    for (size_t i = 0; i < scene_.materials.size(); ++i) {
      std::string name = scene_.materials[i].name;
      for (size_t n = i; name.empty(); ++n) {
        const std::string free = fmt::format("material {}", n);
        if (taken.insert(free).second) name = free;
      }
      names_.push_back(std::move(name));
    }
  }

  void number(const Parameter& p, double v) {
    if (p.type == ParameterType::kBool) {
      out_ += v != 0 ? "true" : "false";
    } else {
      fmt::format_to(std::back_inserter(out_), "{}", v);
    }
  }

  // `may_be_file`: the directive's string parameters may be file names.
  void parameter(const Parameter& p, bool may_be_file) {
    constexpr size_t kPerLine = 12;
    const bool file = may_be_file && p.type == ParameterType::kString &&
                      std::find(std::begin(kFileParameters), std::end(kFileParameters), p.name) !=
                          std::end(kFileParameters);
    fmt::format_to(std::back_inserter(out_), " \"{} {}\" [", parameter_type_name(p.type), p.name);
    for (size_t i = 0; i < p.numbers.size(); ++i) {
      if (i > 0 && i % kPerLine == 0) out_ += '\n';
      out_ += ' ';
      number(p, p.numbers[i]);
    }
    for (const std::string& s : p.strings) out_ += ' ' + in_quotes(file ? files_.file(s, p.location) : s);
    out_ += " ]";
  }

  // Skips inherited defaults (from `Attribute`) that this type does not take.
  void parameters(std::string_view directive, const Directive& d, bool may_be_file = true) {
    const TypeSpec* type = nullptr;
    for (const Category& c : categories()) {
      if (c.directive != directive) continue;
      for (const TypeSpec* t : c.types) type = t->name == d.type ? t : type;
    }
    for (const Parameter& p : d.parameters) {
      if (!p.inherited || (type && type->find(p.name))) parameter(p, may_be_file);
    }
    out_ += '\n';
  }

  void directive(std::string_view word, const Directive& d, bool may_be_file = true) {
    out_.append(indent_, ' ');
    out_ += fmt::format("{} {}", word, in_quotes(d.type));
    parameters(word, d, may_be_file);
  }

  // `Transform` replaces the whole current transform.
  void transform(const glm::dmat4& m) {
    out_.append(indent_, ' ');
    out_ += "Transform [";
    for (int c = 0; c < 4; ++c) {
      for (int r = 0; r < 4; ++r) fmt::format_to(std::back_inserter(out_), " {}", m[c][r]);
    }
    out_ += " ]\n";
  }

  void placed_directive(std::string_view word, const Directive& d, const glm::dmat4& m) {
    if (m == glm::dmat4(1)) return directive(word, d);
    begin();
    transform(m);
    directive(word, d);
    end();
  }

  void settings() {
    if (scene_.camera) {
      enter({scene_.camera->medium, scene_.camera->medium});
      const glm::dmat4 m = pbrt::inverse_transform(scene_.camera->camera_to_world);
      if (m != glm::dmat4(1)) transform(m);
      directive("Camera", *scene_.camera);
      if (!scene_.camera->medium.name.empty()) line("MediumInterface \"\"");
    }
    for (const auto& [word, setting] :
         {std::pair{"Film", &scene_.film}, std::pair{"Sampler", &scene_.sampler},
          std::pair{"PixelFilter", &scene_.filter}, std::pair{"Integrator", &scene_.integrator},
          std::pair{"Accelerator", &scene_.accelerator}}) {
      if (*setting) directive(word, **setting, false);
    }
    for (const Parameter& option : scene_.options) {
      out_ += "Option";
      parameter(option, false);
      out_ += '\n';
    }
  }

  void write_medium(const MediumDescription& m) {
    const bool moved = m.type == "uniformgrid" && m.medium_to_world != glm::dmat4(1);
    if (moved) transform(m.medium_to_world);
    out_ += fmt::format("MakeNamedMedium {} \"string type\" {}", in_quotes(m.name), in_quotes(m.type));
    parameters("MakeNamedMedium", m);
    if (moved) line("Identity");
  }

  // Writes the media of what follows unless they are the vacuum.
  void enter(const MediaReference& media) {
    if (!media.inside.name.empty() || !media.outside.name.empty())
      line(fmt::format("MediumInterface {} {}", in_quotes(media.inside.name), in_quotes(media.outside.name)));
  }

  void write_light(const LightDescription& light) {
    if (light.medium.name.empty()) return placed_directive("LightSource", light, light.light_to_world);
    begin();
    enter({light.medium, light.medium});
    placed_directive("LightSource", light, light.light_to_world);
    end();
  }

  void write_texture(const TextureDescription& t) {
    const bool moved = t.texture_to_world != glm::dmat4(1);
    if (moved) {
      begin();
      transform(t.texture_to_world);
    }
    out_.append(indent_, ' ');
    out_ += fmt::format("Texture {} {} {}", in_quotes(t.name), in_quotes(t.value_type), in_quotes(t.type));
    parameters("Texture", t);
    if (moved) end();
  }

  void material(const MaterialDescription& m, const std::string& name) {
    out_ += fmt::format("MakeNamedMaterial {} \"string type\" {}", in_quotes(name), in_quotes(m.type));
    parameters("Material", m);
  }

  void write_shape(const ShapeDescription& shape) {
    begin();
    if (shape.object_to_world != glm::dmat4(1)) transform(shape.object_to_world);
    const MaterialReference& m = shape.material;
    if (m.index || !m.name.empty()) line("NamedMaterial " + in_quotes(m.index ? names_[*m.index] : m.name));
    if (shape.area_light) directive("AreaLightSource", scene_.area_lights[*shape.area_light]);
    if (shape.reverse_orientation) line("ReverseOrientation");
    enter(shape.media);
    const std::string mesh = shape.type == "trianglemesh" ? files_.mesh(shape) : "";
    if (mesh.empty()) {
      directive("Shape", shape);
    } else {
      mesh_line(shape, mesh);
    }
    end();
  }

  // Writes a "plymesh"; parameters that the PLY file does not hold stay in the text.
  void mesh_line(const ShapeDescription& shape, const std::string& file) {
    ShapeDescription rest = shape;
    rest.type = "plymesh";
    std::erase_if(rest.parameters, [](const Parameter& p) {
      return p.name == "P" || p.name == "N" || p.name == "uv" || p.name == "Cd" || p.name == "indices";
    });
    out_.append(indent_, ' ');
    out_ += fmt::format("Shape \"plymesh\" \"string filename\" [ {} ]", in_quotes(file));
    parameters("Shape", rest);
  }

  void write_object(const ObjectDescription& object) {
    begin("ObjectBegin " + in_quotes(object.name));
    for (const ShapeDescription& shape : object.shapes) write_shape(shape);
    end("ObjectEnd");
  }

  void write_instance(const InstanceDescription& instance) {
    begin();
    if (instance.instance_to_world != glm::dmat4(1)) transform(instance.instance_to_world);
    line("ObjectInstance " + in_quotes(instance.object));
    end();
  }

  const SceneDescription& scene_;
  const SceneTextFiles& files_;
  std::vector<std::string> names_;  // of materials
  std::string out_;
  size_t indent_ = 0;
};

}  // namespace

std::string scene_text(const SceneDescription& scene, const SceneTextFiles& files) {
  return Writer(scene, files).write();
}

}  // namespace kaustik::app
