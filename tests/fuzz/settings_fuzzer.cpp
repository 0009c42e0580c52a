// The file of a plugin's settings: read, changed, and read again.
#include "fuzz/fuzzing.hpp"
#include "fuzz/temporary_folder.hpp"
#include "host/plugins/settings_store.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace jet;
    static const PropertyTable table{real("width", "Width", 2).range(0, 100),
                                     integer("count", "Count", 3),
                                     flag("on", "On", false),
                                     text("note", "Note", "", true),
                                     choice("join", "Join", {"miter", "round"}),
                                     color("color", "Color", {1, 2, 3, 4})};
    fuzz::put(fuzz::temporaryFolder() / "org.test.json", {reinterpret_cast<const char*>(data), size});
    host::SettingsStore store(fuzz::temporaryFolder());
    const auto page = store.page("org.test", "page", table);
    const double width = page->get<double>("width");
    fuzz::require(width >= 0 && width <= 100, "a value is one that the table admits");
    if (!page->set("note", std::string("written"))) return 0;  // the file is not JSON, and stays
    const auto again = store.page("org.test", "page", table);
    fuzz::require(again->get<std::string>("note") == "written", "what was set is there");
    fuzz::require(again->get<double>("width") == width, "and the rest is as before");
    return 0;
}
