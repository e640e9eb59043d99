#pragma once
// The media of a description, by name.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/medium/medium.h"
#include "core/scene/schema/schema.h"

namespace kaustik {

class MediumTable {
 public:
  // Makes every medium; reports invalid ones and names defined twice.
  MediumTable(const SceneDescription& description, WarnedOnce& warned, DiagnosticList& diagnostics);

  // The vacuum where no medium is named, and for one that changes no light; with an error where there is none
  // of that name, once a name.
  MediumIndex resolve(const MediumReference& reference, DiagnosticList& diagnostics);
  MediumInterface resolve(const MediaReference& references, DiagnosticList& diagnostics) {
    return {resolve(references.inside, diagnostics), resolve(references.outside, diagnostics)};
  }

  // By MediumIndex; empty if there is none but the vacuum. Places their grids relative to the scene's origin.
  std::vector<Medium> finish(const glm::dvec3& origin);
  std::vector<std::string>& names() { return names_; }

 private:
  MediumIndex make(const MediumDescription& description, WarnedOnce& warned, DiagnosticList& diagnostics);

  std::vector<Medium> media_;
  std::vector<std::pair<MediumIndex, const MediumDescription*>> grids_;
  std::vector<std::string> names_;
  std::map<std::string_view, MediumIndex, std::less<>> by_name_;
  std::set<std::string_view> reported_;  // undefined names
};

}  // namespace kaustik
