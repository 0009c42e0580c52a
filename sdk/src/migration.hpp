// Reading what an older JET wrote: a step for each version of the project format, made on the XML before it is read.
//
// A new version of the format: raise kFormatVersion, add a step from the former one to the table in migration.cpp, and
// a fixture of it to tests/fixtures/formats. Steps are never changed: files of their version are out there.
#pragma once

#include "xml_text.hpp"

#include <jet/catalog.hpp>
#include <jet/format.hpp>
#include <jet/scene.hpp>

#include <memory>
#include <vector>

namespace jet {

inline constexpr int kFormatVersion = 1;

/// Brings a parsed project.jet (root element <jet-project>) or scene file (<scene>) to kFormatVersion, and tells the
/// version it had. Throws Failure, at the root's place, for versions this JET cannot read.
int migrate(XmlSource& source);

/// As readSceneText(), and tells which version of the format the text has.
Result<std::unique_ptr<Scene>> readSceneText(std::string text, const std::string& file, EventsCenter& events,
                                             Catalog& catalog, std::vector<FormatNote>& notes, int& version);

}  // namespace jet
