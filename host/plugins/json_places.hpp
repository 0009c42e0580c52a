// Where in a JSON text a value stands, for messages. JSON libraries forget it; this finds it again, when it is needed.
#pragma once

#include <jet/result.hpp>

#include <cstddef>
#include <map>
#include <string>

namespace jet::host {

class JsonPlaces {
public:
    /// `text` is valid JSON, comments allowed.
    JsonPlaces(const std::string& text, std::string file);

    /// Of the value with this JSON pointer ("/contributes/tools/0/id"): of its key, where it has one. The nearest
    /// enclosing value where it does not exist.
    Location of(std::string pointer) const;
    /// Of a byte of the text.
    static Location at(const std::string& text, std::size_t offset, const std::string& file);

private:
    const std::string& text_;
    std::string file_;
    std::map<std::string, std::size_t> offsets_;
};

}  // namespace jet::host
