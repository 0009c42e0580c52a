#include "json_places.hpp"

#include <algorithm>

namespace jet::host {

namespace {

constexpr int kDeepest = 64;

class Scanner {
public:
    Scanner(const std::string& text, std::map<std::string, std::size_t>& offsets) : text_(text), offsets_(offsets) {}

    void run()
    {
        skipBlanks();
        value("", at_);
    }

private:
    char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }

    void skipBlanks()
    {
        at_ = std::min(at_, text_.size());
        for (;;) {
            while (at_ < text_.size() && std::string_view(" \t\r\n\xef\xbb\xbf").find(here()) != std::string_view::npos)
                ++at_;
            if (text_.compare(at_, 2, "//") == 0)
                at_ = std::min(text_.find_first_of(std::string_view("\n\r\0", 3), at_), text_.size());
            else if (text_.compare(at_, 2, "/*") == 0)
                at_ = std::min(text_.find("*/", at_ + 2), text_.size() - 2) + 2;
            else
                return;
        }
    }

    std::string string()
    {
        std::string content;
        for (++at_; at_ < text_.size() && here() != '"'; ++at_) {
            if (here() == '\\') ++at_;
            content += here();
        }
        ++at_;
        return content;
    }

    void value(const std::string& pointer, std::size_t offset)
    {
        offsets_.emplace(pointer, offset);
        if (here() == '{') return members(pointer, '}');
        if (here() == '[') return members(pointer, ']');
        if (here() == '"') return void(string());
        while (at_ < text_.size() && std::string_view(",]} \t\r\n/").find(here()) == std::string_view::npos) ++at_;
    }

    void members(const std::string& pointer, char end)
    {
        if (++depth_ > kDeepest) at_ = text_.size();  // nobody writes this by hand: the enclosing value will do
        ++at_;
        for (int index = 0; at_ < text_.size(); ++index) {
            skipBlanks();
            // No value begins with these; a text with an error goes no farther.
            if (here() == end || here() == '}' || here() == ']' || here() == '\0') break;
            const std::size_t start = at_;
            std::string name = std::to_string(index);
            if (end == '}') {
                name = string();
                skipBlanks();
                ++at_;  // the colon
                skipBlanks();
            }
            value(pointer + '/' + name, start);
            skipBlanks();
            if (here() != ',') break;
            ++at_;
        }
        ++at_;
        --depth_;
    }

    const std::string& text_;
    std::map<std::string, std::size_t>& offsets_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace

JsonPlaces::JsonPlaces(const std::string& text, std::string file) : text_(text), file_(std::move(file))
{
    Scanner(text, offsets_).run();
}

Location JsonPlaces::of(std::string pointer) const
{
    auto found = offsets_.find(pointer);
    while (found == offsets_.end() && !pointer.empty()) {
        pointer.erase(pointer.rfind('/'));
        found = offsets_.find(pointer);
    }
    return at(text_, found == offsets_.end() ? 0 : found->second, file_);
}

Location JsonPlaces::at(const std::string& text, std::size_t offset, const std::string& file)
{
    offset = std::min(offset, text.size());
    const std::size_t newline = offset == 0 ? std::string::npos : text.rfind('\n', offset - 1);
    const auto here = text.begin() + static_cast<std::ptrdiff_t>(offset);
    const std::size_t column = newline == std::string::npos ? offset + 1 : offset - newline;
    return {file, static_cast<int>(std::count(text.begin(), here, '\n')) + 1, static_cast<int>(column)};
}

}  // namespace jet::host
