#include "symbol_text.hpp"

#include <charconv>

namespace jet {

namespace {

void appendRange(std::string& out, std::uint64_t first, std::uint64_t last)
{
    if (out.back() != '"') out += ' ';
    out += std::to_string(first);
    if (last > first) out += (last == first + 1 ? ' ' : '-') + std::to_string(last);
}

}  // namespace

void appendInstance(std::string& out, const Item& instance)
{
    out += "<instance symbol=\"" + std::to_string(linkOf(instance).value) + '"';
    const Affine m = placementOf(instance);
    if (!m.isIdentity()) {
        out += " matrix=\"";
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 2; ++row) {
                if (column + row > 0) out += ' ';
                appendNumber(out, m(row, column));
            }
        out += '"';
    }
    if (!instance.children().empty()) {
        out += " ids=\"";
        std::uint64_t first = 0, last = 0;
        for (const auto& child : instance.children())
            child->walk([&](const Item& item) {
                const std::uint64_t id = item.id().value;
                if (last != 0 && id == last + 1) return void(last = id);
                if (last != 0) appendRange(out, first, last);
                first = last = id;
            });
        appendRange(out, first, last);
        out += '"';
    }
    out += "/>\n";
}

std::optional<Affine> parseMatrix(std::string_view text)
{
    double numbers[6];
    for (double& number : numbers) {
        while (text.starts_with(' ')) text.remove_prefix(1);
        if (!readNumber(text, number)) return std::nullopt;
    }
    if (!text.empty()) return std::nullopt;
    return withoutSignedZeros(Affine::fromSvg(numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]));
}

namespace {

bool readId(std::string_view& text, std::uint64_t& id)
{
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), id);
    if (problem != std::errc() || id == 0 || id > kMaximumId) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return true;
}

}  // namespace

std::optional<std::vector<ItemId>> parseIds(std::string_view text)
{
    std::vector<ItemId> ids;
    while (!text.empty()) {
        if (text.starts_with(' ')) {
            text.remove_prefix(1);
            continue;
        }
        std::uint64_t first = 0;
        if (!readId(text, first)) return std::nullopt;
        std::uint64_t last = first;
        if (text.starts_with('-')) {
            text.remove_prefix(1);
            if (!readId(text, last) || last < first) return std::nullopt;
        }
        if (last - first >= kMaximumInstanceItems || ids.size() + (last - first) >= kMaximumInstanceItems)
            return std::nullopt;
        for (std::uint64_t id = first; id <= last; ++id) ids.push_back(ItemId{id});
    }
    return ids;
}

namespace {

class Expander {
public:
    Expander(Scene& scene, const std::vector<InstanceRecord>& records) : scene_(scene), builder_(scene)
    {
        for (const InstanceRecord& record : records) {
            records_.emplace(record.instance.value, &record);
            for (const ItemId id : record.ids) free_ = std::max(free_, id.value + 1);
        }
        for (const Item* top : {&scene.root(), scene.items().find(kSymbolsId)})
            top->walk([&](const Item& item) {
                if (item.parent()) free_ = std::max(free_, item.id().value + 1);
            });
    }

    void run(const std::vector<InstanceRecord>& records)
    {
        for (const auto& symbol : scene_.items().find(kSymbolsId)->children()) sizeOf(*symbol);
        std::size_t all = 0;
        for (const InstanceRecord& record : records) {
            all += sizeOf(symbolOf(record));
            if (all > kMaximumInstanceItems)
                fail(record, "symbols in symbols would make more than " + std::to_string(kMaximumInstanceItems) +
                                 " items; use fewer instances");
        }
        for (const InstanceRecord& record : records) expand(*scene_.items().find(record.instance));
    }

private:
    [[noreturn]] static void fail(const InstanceRecord& record, const std::string& what)
    {
        throw Failure(Error(what, record.where));
    }

    const Item& symbolOf(const InstanceRecord& record) const
    {
        const ItemId link = linkOf(*scene_.items().find(record.instance));
        const Item* symbol = scene_.items().find(link);
        if (!symbol || !isSymbol(*symbol))
            fail(record,
                 "there is no symbol with the id " + std::to_string(link.value) + "; symbols stand in <symbols>");
        return *symbol;
    }

    static std::vector<const Item*> instancesIn(const Item& symbol)
    {
        std::vector<const Item*> instances;
        walkMembers(symbol, [&](const Item& item) {
            if (isInstance(item)) instances.push_back(&item);
        });
        return instances;
    }

    /// The items an instance of the symbol will have, counted before any is made: small files can ask for millions.
    std::size_t sizeOf(const Item& symbol)
    {
        if (const auto known = sizes_.find(symbol.id().value); known != sizes_.end()) return known->second;
        under_.push_back(symbol.id());
        std::size_t size = 0;
        walkMembers(symbol, [&](const Item&) { ++size; });
        for (const Item* instance : instancesIn(symbol)) {
            const InstanceRecord& record = *records_.at(instance->id().value);
            const Item& inner = symbolOf(record);
            if (std::ranges::find(under_, inner.id()) != under_.end())
                fail(record, "the symbol '" + inner.name() + "' would be a part of itself; remove this instance");
            if (under_.size() > kMaximumDepth) fail(record, "symbols are nested more than 1000 deep in each other");
            size = std::min(size + sizeOf(inner), kMaximumInstanceItems + 1);
        }
        under_.pop_back();
        sizes_.emplace(symbol.id().value, size);
        return size;
    }

    /// Instances inside of its symbol get their items before it is used itself.
    void expand(const Item& instance)
    {
        if (!done_.insert(instance.id().value).second) return;
        const InstanceRecord& record = *records_.at(instance.id().value);
        const Item& symbol = symbolOf(record);
        for (const Item* inner : instancesIn(symbol)) expand(*inner);
        auto next = record.ids.begin();
        InstanceContent content([&] { return next != record.ids.end() ? *next++ : ItemId{free_++}; },
                                [&](ItemId id) { return scene_.items().find(id); }, kMaximumInstanceItems);
        try {
            for (const auto& item : content.of(symbol, placementOf(instance))) add(const_cast<Item&>(instance), *item);
        } catch (const Failure& failure) {
            fail(record, failure.what());
        }
    }

    void add(Item& parent, const Item& built)
    {
        Item& item = builder_.add(parent, built.id(), built.type());
        builder_.setName(item, built.name());
        builder_.setFlags(item, built.visible(), built.locked());
        builder_.setPath(item, built.path());
        builder_.setProperties(item, built.properties());
        for (const EffectInstance& effect : built.effects()) builder_.addEffect(item, effect);
        for (const auto& child : built.children()) add(item, *child);
    }

    Scene& scene_;
    SceneBuilder builder_;
    std::unordered_map<std::uint64_t, const InstanceRecord*> records_;
    std::unordered_map<std::uint64_t, std::size_t> sizes_;  // by symbol
    std::unordered_set<std::uint64_t> done_;                // instances
    std::vector<ItemId> under_;                             // symbols being counted
    std::uint64_t free_ = 1;
};

}  // namespace

void expandInstances(Scene& scene, const std::vector<InstanceRecord>& records)
{
    if (!records.empty()) Expander(scene, records).run(records);
}

}  // namespace jet
