// Keyboard.getKey(name).isPressed()
#include "bindings.hpp"
#include "native.hpp"
#include "text.hpp"

#include <jet/simulation.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace jet::duktape {

namespace {

constexpr std::array<std::string_view, 15> kNamedKeys{"Left",  "Right",   "Up",        "Down",   "Space",
                                                      "Enter", "Escape",  "Backspace", "Delete", "Tab",
                                                      "Shift", "Control", "Alt",       "Home",   "End"};

bool isNamedKey(std::string_view name)
{
    if (std::ranges::find(kNamedKeys, name) != kNamedKeys.end()) return true;
    if (name.size() < 2 || name.size() > 3 || name[0] != 'F') return false;
    const std::string_view digits = name.substr(1);
    return std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
}

// How many characters there are in UTF-8 text.
std::size_t characters(std::string_view text)
{
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }));
}

// As KeyEvent names it: letters are upper case. Warns of names that no key has.
duk_ret_t keyName(Native& call)
{
    std::string name = call.text(0);
    if (name.size() == 1 && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 'a' + 'A');
    if (name == " ") name = "Space";
    if (characters(name) != 1 && !isNamedKey(name))
        call.play.warn(
            call.ctx,
            "no key is called \"" + shortened(name, 40) +
                "\"; keys are \"A\" to \"Z\", \"0\" to \"9\", \"Left\", \"Space\", \"Enter\", \"F1\" and so on");
    pushText(call.ctx, name);
    return 1;
}

duk_ret_t isPressed(Native& call) { return call.give(call.play.simulation.isPressed(stringAt(call.ctx, 0))); }

}  // namespace

void bindKeyboard(duk_context* ctx, duk_idx_t kit)
{
    duk_dup(ctx, kit);
    method<keyName>(ctx, "keyName", 1);
    method<isPressed>(ctx, "isPressed", 1);
    duk_pop(ctx);
}

}  // namespace jet::duktape
