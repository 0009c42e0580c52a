// Finds what is wrong with a scene file and mends what can be mended without asking.
#pragma once

#include "xml_file.hpp"

#include <jet/catalog.hpp>

namespace jet::host {

/// Looks at each element of the scene, and changes the tree so that the findings that have a repair are gone. What
/// belongs to plugins that are absent is not looked at.
Findings mendScene(XmlFile& scene, Catalog& catalog);

}  // namespace jet::host
