// Which script a piece of code came from: each gets a file name of its own, which Duktape notes in functions and
// tracebacks.
#pragma once

#include <jet/item.hpp>

#include <map>
#include <string>
#include <string_view>

namespace jet::duktape {

class ScriptFiles {
public:
    /// The item's name, without what would confuse a traceback, and with a number where two scripts have the same name.
    const std::string& add(const Item& script)
    {
        if (const auto known = byItem_.find(script.id()); known != byItem_.end()) return known->second;
        std::string name = script.name().empty() ? std::string("script") : script.name();
        for (char& c : name)
            if (c == '(' || c == ')' || c == ':' || c == '\n' || c == '\r' || c == '\0') c = '_';
        std::string unique = name;
        for (int n = 2; byName_.contains(unique); ++n) unique = name + " #" + std::to_string(n);
        byName_[unique] = script.id();
        return byItem_[script.id()] = unique;
    }
    /// The script of that file name; none if it is not one of ours.
    ItemId find(std::string_view name) const
    {
        const auto found = byName_.find(name);
        return found == byName_.end() ? ItemId{} : found->second;
    }

private:
    std::map<std::string, ItemId, std::less<>> byName_;
    std::map<ItemId, std::string> byItem_;
};

}  // namespace jet::duktape
