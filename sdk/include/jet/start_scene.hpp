// The start scene: what plays, and opens first, when no scene is named.
#pragma once

#include <jet/project.hpp>

namespace jet {

/// The one chosen by ProjectTree::makeStart(), kept as the attribute `start` of project.jet; else the project's first.
/// Null for a project without scenes. [owner's thread]
JET_API Scene* startScene(const Project& project);

}  // namespace jet
