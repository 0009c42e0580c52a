// plugin.json of a plugin somebody sent.
#include "fuzz/fuzzing.hpp"
#include "host/plugins/manifest.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace jet;
    const auto manifest = host::Manifest::parse(std::string(reinterpret_cast<const char*>(data), size), "plugin.json");
    if (!manifest) {
        fuzz::require(!manifest.error().message.empty(), "an error says what is wrong");
        return 0;
    }
    fuzz::require(!manifest->id.empty(), "a manifest that is accepted has an id");
    fuzz::require(manifest->library.find('/') == std::string::npos, "its library lies in its folder");
    for (const Error& warning : manifest->warnings) fuzz::require(warning.where.line > 0, "a warning has its line");
    return 0;
}
