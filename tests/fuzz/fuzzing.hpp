// What the fuzz targets share: a catalog with an effect and an item type, and a way to say that something must hold.
#pragma once

#include "fixtures/fakes.hpp"
#include "support/test_catalog.hpp"

#include <jet/project.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace jet::fuzz {

inline test::TestCatalog& catalog()
{
    static test::TestCatalog& the = []() -> test::TestCatalog& {
        static test::TestCatalog made;
        made.inCode().effect<test::TintEffect>("tint");
        made.inCode().effect<test::BoxBodyEffect>("box-body");
        made.inCode().itemType<test::RopeType>("rope");
        return made;
    }();
    return the;
}

/// A crash with a sentence, for the fuzzer to find.
inline void require(bool holds, const char* what)
{
    if (holds) return;
    std::fprintf(stderr, "this does not hold: %s\n", what);
    std::abort();
}

/// What was read can be written, and what was written reads as the same: the second time it is the same text.
inline void requireStable(const Scene& scene)
{
    EventsCenter events;
    std::vector<FormatNote> notes;
    const std::string once = writeSceneText(scene);
    const auto again = readSceneText(once, "again.scene", events, catalog(), notes);
    require(static_cast<bool>(again), again ? "" : again.error().message.c_str());
    require(writeSceneText(**again) == once, "a scene that was written reads as the same");
    require((*again)->hash() == scene.hash(), "and has the same hash");
}

}  // namespace jet::fuzz
