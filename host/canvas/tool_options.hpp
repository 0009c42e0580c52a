// ToolOptions: what the user chose for each tool's options. One store for all views; kept between runs by the window.
#pragma once

#include <jet/property.hpp>

#include <map>
#include <string>
#include <string_view>

namespace jet::host {

class ToolOptions {
public:
    /// The values of one tool; the reference stays valid.
    const Properties& of(std::string_view tool) { return entry(tool); }
    void set(std::string_view tool, std::string_view property, Value value)
    {
        entry(tool).set(property, std::move(value));
    }
    const std::map<std::string, Properties, std::less<>>& all() const { return values_; }

private:
    Properties& entry(std::string_view tool)
    {
        const auto found = values_.find(tool);
        return found != values_.end() ? found->second : values_.emplace(std::string(tool), Properties{}).first->second;
    }

    std::map<std::string, Properties, std::less<>> values_;
};

}  // namespace jet::host
