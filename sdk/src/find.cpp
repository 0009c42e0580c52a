#include <jet/find.hpp>
#include <jet/symbols.hpp>

#include <array>

namespace jet {

namespace {

enum class Compare { Text, Equal, NotEqual, Less, LessOrEqual, Greater, GreaterOrEqual };

char folded(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string folded(std::string_view text)
{
    std::string result(text);
    for (char& c : result) c = folded(c);
    return result;
}

/// `pattern` is folded; '*' stands for any text, '?' for any character. Looks back to the last '*' only, which is
/// enough, so the cost is at most the product of both lengths.
bool fits(std::string_view text, std::string_view pattern)
{
    std::size_t t = 0, p = 0, star = std::string_view::npos, from = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++, from = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == folded(text[t]))) {
            ++p, ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1, t = ++from;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

struct Term {
    bool negated = false;
    Compare compare = Compare::Text;
    std::string key;    ///< empty: the name has the text in it
    std::string value;  ///< folded
    std::optional<double> number = {};
    char component = 0;  ///< 'x' or 'y' of a vector
};

const Item* layerAround(const Item& item)
{
    const Item* layer = &item;
    while (layer && !layer->is<LayerItem>()) layer = layer->parent();
    return layer;
}

constexpr std::array<std::pair<std::string_view, bool (*)(const Item&)>, 7> kStates{{
    {"hidden", [](const Item& item) { return !item.shown(); }},
    {"visible", [](const Item& item) { return item.shown(); }},
    {"locked", [](const Item& item) { return !item.editable(); }},
    {"unlocked", [](const Item& item) { return item.editable(); }},
    {"instance", [](const Item& item) { return isInstance(item); }},
    {"group", [](const Item& item) { return item.isContainer(); }},
    {"empty", [](const Item& item) { return item.path().isEmpty() && item.children().empty(); }},
}};

// --- values

std::optional<double> numberOf(const Value& value, char component)
{
    if (const auto* v = value.get<Vec2>()) {
        if (component == 0) return std::nullopt;
        return component == 'x' ? v->x() : v->y();
    }
    if (component != 0) return std::nullopt;
    if (const auto* real = value.get<double>()) return *real;
    if (const auto* integer = value.get<std::int64_t>()) return static_cast<double>(*integer);
    return std::nullopt;
}

bool compares(Compare compare, double number, double with)
{
    switch (compare) {
    case Compare::Equal: return number == with;
    case Compare::NotEqual: return number != with;
    case Compare::Less: return number < with;
    case Compare::LessOrEqual: return number <= with;
    case Compare::Greater: return number > with;
    default: return number >= with;
    }
}

/// As numbers where both are; else as texts, which have no order.
bool compares(const Term& term, const Value& value)
{
    if (term.compare != Compare::Text && term.number)
        if (const std::optional<double> number = numberOf(value, term.component))
            return compares(term.compare, *number, *term.number);
    switch (term.compare) {
    case Compare::Text:
    case Compare::Equal: return fits(value.text(), term.value);
    case Compare::NotEqual: return !fits(value.text(), term.value);
    default: return false;
    }
}

bool propertyMatches(const Term& term, const Item& item)
{
    if (const Value* own = item.properties().find(term.key); own && compares(term, *own)) return true;
    if (const auto common = item.property(term.key); common && compares(term, *common)) return true;
    for (const EffectInstance& effect : item.effects())
        if (const Value* value = effect.properties.find(term.key); value && compares(term, *value)) return true;
    return false;
}

/// The symbol's name is that of no item in the scene: it is found by way of the tree of symbols, which the link names.
bool showsSymbol(const Term& term, const Item& item, const Scene* scene)
{
    const Item* holder = isInstance(item) ? &item : holderOf(item);
    const Item* symbol = holder && scene ? symbolOf(*scene, *holder) : nullptr;
    return symbol && fits(symbol->name(), term.value);
}

bool holds(const Term& term, const Item& item, const Scene* scene)
{
    if (term.key.empty()) return fits(item.name(), term.value);
    if (term.compare == Compare::Text) {
        if (term.key == "name") return fits(item.name(), term.value);
        if (term.key == "type") return fits(item.type(), term.value);
        if (term.key == "id") return std::to_string(item.id().value) == term.value;
        if (term.key == "effect")
            return std::ranges::any_of(item.effects(), [&](const auto& e) { return fits(e.type, term.value); });
        if (term.key == "symbol") return showsSymbol(term, item, scene);
        if (term.key == "layer") {
            const Item* layer = layerAround(item);
            return layer && layer != &item && fits(layer->name(), term.value);
        }
        if (term.key == "is")
            for (const auto& [name, test] : kStates)
                if (name == term.value) return test(item);
    }
    return propertyMatches(term, item);
}

// --- reading

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n'; }
bool isKey(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' ||
           c == '_';
}

class QueryReader {
public:
    explicit QueryReader(std::string_view text) : text_(text) {}

    Result<std::vector<Term>> read()
    {
        std::vector<Term> terms;
        for (;;) {
            while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
            if (at_ == text_.size()) return terms;
            auto term = readTerm();
            if (!term) return term.error();
            terms.push_back(std::move(*term));
        }
    }

private:
    Error wrong(std::size_t where, std::string message) const
    {
        return Error(std::move(message), Location{"", 1, static_cast<int>(where) + 1});
    }

    Result<Term> readTerm()
    {
        Term term;
        const std::size_t begin = at_;
        if (text_[at_] == '-') {
            term.negated = true;
            if (++at_ == text_.size() || isSpace(text_[at_]))
                return wrong(begin, "\"-\" stands before what is not wanted, without a space: -type:shape.");
        }
        const std::size_t keyBegin = at_;
        while (at_ < text_.size() && isKey(text_[at_])) ++at_;
        const std::string key = folded(text_.substr(keyBegin, at_ - keyBegin));
        const Compare compare = readOperator();
        if (compare == Compare::Text && (at_ == keyBegin + key.size())) {  // no operator: a word of the name
            at_ = keyBegin;
            auto word = readText();
            if (!word) return word.error();
            term.value = word->find_first_of("*?") == std::string::npos ? "*" + *word + "*" : *word;
            return term;
        }
        if (key.empty()) return wrong(keyBegin, "Here a property is missing: mass>2.");
        term.key = key, term.compare = compare;
        return readValue(std::move(term), keyBegin);
    }

    /// Text for ":" and where there is none.
    Compare readOperator()
    {
        static constexpr std::pair<std::string_view, Compare> kOperators[] = {
            {":", Compare::Text},         {"!=", Compare::NotEqual},
            {"<=", Compare::LessOrEqual}, {">=", Compare::GreaterOrEqual},
            {"=", Compare::Equal},        {"<", Compare::Less},
            {">", Compare::Greater}};
        for (const auto& [sign, compare] : kOperators)
            if (text_.substr(at_).starts_with(sign)) return at_ += sign.size(), compare;
        return Compare::Text;
    }

    Result<Term> readValue(Term term, std::size_t keyBegin)
    {
        const std::size_t begin = at_;
        auto text = readText();
        if (!text) return text.error();
        if (text->empty() && (at_ == begin))
            return wrong(begin,
                         "After \"" + std::string(text_.substr(keyBegin, begin - keyBegin)) + "\" a value is missing.");
        term.value = std::move(*text);
        if (term.key == "is" && std::ranges::none_of(kStates, [&](const auto& s) { return s.first == term.value; }))
            return wrong(begin, "\"is:\" knows hidden, visible, locked, unlocked, instance, group and empty, not \"" +
                                    term.value + "\".");
        if (term.compare == Compare::Text) return term;
        std::string_view digits = term.value;
        double number = 0;
        if (readNumber(digits, number) && digits.empty()) term.number = number;
        const bool order = term.compare != Compare::Equal && term.compare != Compare::NotEqual;
        if (order && !term.number)
            return wrong(begin, "\"" + term.value + "\" is not a number; compare text with \":\".");
        if (term.key.ends_with(".x") || term.key.ends_with(".y")) {
            term.component = term.key.back();
            term.key.resize(term.key.size() - 2);
        }
        return term;
    }

    /// A word, or anything in quotes; folded.
    Result<std::string> readText()
    {
        if (at_ < text_.size() && text_[at_] == '"') {
            const std::size_t end = text_.find('"', at_ + 1);
            if (end == std::string_view::npos) return wrong(at_, "This quotation mark has no second one.");
            std::string quoted = folded(text_.substr(at_ + 1, end - at_ - 1));
            at_ = end + 1;
            return quoted;
        }
        const std::size_t begin = at_;
        while (at_ < text_.size() && !isSpace(text_[at_])) ++at_;
        return folded(text_.substr(begin, at_ - begin));
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace

struct FindQuery::Private {
    std::vector<Term> terms;

    bool matches(const Item& item, const Scene* scene) const
    {
        return !terms.empty() &&
               std::ranges::all_of(terms, [&](const Term& term) { return holds(term, item, scene) != term.negated; });
    }
};

FindQuery::FindQuery() : d_(std::make_shared<Private>()) {}

Result<FindQuery> FindQuery::parse(std::string_view text)
{
    auto terms = QueryReader(text).read();
    if (!terms) return terms.error();
    FindQuery query;
    query.d_ = std::make_shared<Private>(Private{std::move(*terms)});
    return query;
}

bool FindQuery::isEmpty() const { return d_->terms.empty(); }
bool FindQuery::matches(const Item& item, const Scene* scene) const { return d_->matches(item, scene); }

std::vector<const Item*> findItems(const Scene& scene, const FindQuery& query)
{
    std::vector<const Item*> found;
    if (query.isEmpty()) return found;
    scene.root().walk([&](const Item& item) {
        if (item.parent() && query.matches(item, &scene)) found.push_back(&item);
    });
    return found;
}

}  // namespace jet
