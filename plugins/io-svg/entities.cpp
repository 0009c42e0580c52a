#include "entities.hpp"

#include <map>
#include <optional>

namespace jet::svg {

namespace {

constexpr std::size_t kMostPerEntity = 64 * 1024;    // bytes one reference may become
constexpr std::size_t kMostInAll = 4 * 1024 * 1024;  // bytes all references together may become
constexpr int kDeepest = 16;

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

void skipSpace(std::string_view& s)
{
    while (!s.empty() && isSpace(s.front())) s.remove_prefix(1);
}

std::string_view takeWord(std::string_view& s)
{
    std::size_t n = 0;
    while (n < s.size() && !isSpace(s[n]) && s[n] != '>' && s[n] != '"' && s[n] != '\'') ++n;
    const std::string_view word = s.substr(0, n);
    s.remove_prefix(n);
    return word;
}

// Character references in a value ("&#60;", "&lt;") stand for markup once the entity is used.
std::string literal(std::string_view value)
{
    static constexpr std::pair<std::string_view, char> kMarkup[] = {{"&lt;", '<'},  {"&#60;", '<'},  {"&gt;", '>'},
                                                                    {"&#62;", '>'}, {"&quot;", '"'}, {"&#34;", '"'},
                                                                    {"&#38;", '&'}, {"&apos;", '\''}};
    std::string out;
    for (std::size_t i = 0; i < value.size();) {
        std::size_t taken = 0;
        for (const auto& [name, character] : kMarkup) {
            if (value.substr(i).starts_with(name)) {
                out += character;
                taken = name.size();
                break;
            }
        }
        if (taken == 0) out += value[i];
        i += taken == 0 ? 1 : taken;
    }
    return out;
}

class Entities {
public:
    // Reads the declarations of the internal subset; returns the offset behind it.
    explicit Entities(std::string_view source)
    {
        const std::size_t type = source.find("<!DOCTYPE");
        const std::size_t root = source.find("<svg");
        if (type == source.npos || type > root) return;
        std::string_view rest = source.substr(type, source.find("]", type) - type);
        for (std::size_t at = rest.find("<!ENTITY"); at != rest.npos; at = rest.find("<!ENTITY")) {
            rest.remove_prefix(at + 8);
            declare(rest);
        }
    }

    bool empty() const { return values_.empty(); }

    // The full text of an entity; none if it is unknown or refused.
    const std::string* full(const std::string& name, int depth = 0)
    {
        const auto value = values_.find(name);
        if (value == values_.end()) return nullptr;
        if (const auto done = full_.find(name); done != full_.end()) return done->second ? &*done->second : nullptr;
        full_.emplace(name, std::nullopt);  // a reference to itself on the way finds this
        std::optional<std::string> text;
        if (depth < kDeepest) text = expand(value->second, depth);
        if (!text) refused_.push_back(name);
        auto& slot = full_[name];
        slot = std::move(text);
        return slot ? &*slot : nullptr;
    }

    std::vector<std::string> takeRefused() { return std::move(refused_); }

private:
    void declare(std::string_view& rest)
    {
        skipSpace(rest);
        const std::string name(takeWord(rest));
        skipSpace(rest);
        if (name.empty() || rest.empty() || (rest.front() != '"' && rest.front() != '\'')) return;
        const std::size_t end = rest.find(rest.front(), 1);
        if (end == rest.npos) return;
        values_.emplace(name, literal(rest.substr(1, end - 1)));
        rest.remove_prefix(end + 1);
    }

    std::optional<std::string> expand(std::string_view value, int depth)
    {
        std::string out;
        for (std::size_t i = 0; i < value.size(); ++i) {
            const std::size_t end = value[i] == '&' ? value.find(';', i) : value.npos;
            if (end == value.npos) {
                out += value[i];
                continue;
            }
            const std::string name(value.substr(i + 1, end - i - 1));
            const bool known = values_.contains(name);
            const std::string* inner = known ? full(name, depth + 1) : nullptr;
            if (known && !inner) return std::nullopt;
            if (inner) {
                out += *inner;
                i = end;
            } else {
                out += value[i];
            }
            if (out.size() > kMostPerEntity) return std::nullopt;
        }
        return out;
    }

    std::map<std::string, std::string> values_;
    std::map<std::string, std::optional<std::string>> full_;
    std::vector<std::string> refused_;
};

std::size_t contentStart(std::string_view source)
{
    const std::size_t type = source.find("<!DOCTYPE");
    const std::size_t end = source.find("]", type);
    return end == source.npos ? 0 : end;
}

}  // namespace

Expansion expandEntities(std::string_view source)
{
    Expansion result;
    Entities entities(source);
    if (entities.empty()) {
        result.text = source;
        return result;
    }
    std::size_t copied = 0, expanded = 0;
    for (std::size_t at = source.find('&', contentStart(source)); at != source.npos; at = source.find('&', at + 1)) {
        const std::size_t end = source.find_first_of("; <\"'", at);
        if (end == source.npos || source[end] != ';') continue;
        const std::string* full = entities.full(std::string(source.substr(at + 1, end - at - 1)));
        if (!full || expanded + full->size() > kMostInAll) continue;
        expanded += full->size();
        result.text += source.substr(copied, at - copied);
        result.places.emplace_back(result.text.size(), at);
        result.text += *full;
        copied = end + 1;
        result.places.emplace_back(result.text.size(), copied);
    }
    result.text += source.substr(copied);
    result.refused = entities.takeRefused();
    return result;
}

}  // namespace jet::svg
