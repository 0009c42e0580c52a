// A million random operations over every kind of change, item and effect, in transactions that are committed, merged,
// nested, restarted, rolled back or left by an exception, undone and redone at random. The model is the log of the
// scene's hashes: whatever path led to a state, its hash must be the one it had when it was made.
//
// JET_TEST_SEED=N in the environment takes another sequence.
#include "geometry_samples.hpp"
#include "scene_fakes.hpp"

#include <jet/item_type.hpp>
#include <jet/project.hpp>
#include <jet/symbols.hpp>

#include <algorithm>
#include <cstdlib>
#include <deque>

namespace jet {
namespace {

constexpr int kOperations = 1'000'000;
constexpr std::size_t kMostItems = 60;

class RandomEdits : public test::SceneFixture {
protected:
    RandomEdits()
    {
        types_ = builtInItemTypeIds();
        types_.push_back("rope");
    }

    // --- choosing

    bool chance(std::size_t one, std::size_t of) { return random_.index(of) < one; }
    template <class T>
    const T& oneOf(const std::vector<T>& all)
    {
        return all[random_.index(all.size())];
    }
    const Item& anyItem()
    {
        everything_.clear();
        scene.root().walk([&](const Item& item) { everything_.push_back(&item); });
        for (const Item* symbol : symbolsOf(scene))
            symbol->walk([&](const Item& item) { everything_.push_back(&item); });
        return *oneOf(everything_);
    }
    const Item& anyContainer()
    {
        for (int tries = 0; tries < 4; ++tries) {
            const Item& item = anyItem();
            if (item.isContainer()) return item;
        }
        return scene.root();
    }
    Path anyPath()
    {
        switch (random_.index(4)) {
        case 0: return {};
        case 1: return Path::ellipse(Box(random_.point(), random_.point()));
        case 2: return Path::line(random_.point(), random_.point());
        default: {
            Path path = Path::rectangle(Box(random_.point(), random_.point()));
            path.setIntermediate(static_cast<int>(random_.index(4)));
            return path;
        }
        }
    }
    std::string anyText() { return std::string(random_.index(30), static_cast<char>('a' + random_.index(26))); }
    Color anyColor() { return {static_cast<std::uint8_t>(random_.bits()), 7, 9, 255}; }

    /// Mostly fitting the declaration.
    Value anyValue(const PropertySpec& spec)
    {
        if (chance(1, 10)) return Value();
        if (chance(1, 40)) return Value("not what is wanted");
        const double lo = std::max(spec.minimum, -1e3), hi = std::min(spec.maximum, 1e3);
        switch (spec.kind) {
        case ValueKind::Bool: return chance(1, 2);
        case ValueKind::Integer: return static_cast<std::int64_t>(random_.real(lo, hi));
        case ValueKind::Real: return random_.real(lo, hi);
        case ValueKind::Vec2: return random_.point(std::min(hi, 100.0));
        case ValueKind::Color: return anyColor();
        case ValueKind::Choice: return oneOf(spec.choices);
        case ValueKind::Item: return anyItem().id();
        case ValueKind::Path: return anyPath();
        default: return anyText();
        }
    }
    const PropertyTable& tableOf(const Item& item)
    {
        const ItemType* builtIn = builtInItemType(item.type());
        return builtIn ? builtIn->properties() : catalog.itemType(item.type())->properties();
    }

    // --- operations

    void changeTree(Transaction& edit)
    {
        const bool many = items().itemCount() > kMostItems;
        switch (many ? 2 : random_.index(5)) {
        case 0:
            edit.add(oneOf(types_), anyContainer(), anyPath(),
                     chance(1, 2) ? std::optional(random_.index(4)) : std::nullopt);
            break;
        case 1: edit.addCopy(anyItem(), anyContainer(), random_.index(4)); break;
        case 2: edit.remove(anyItem()); break;
        case 3: edit.move(anyItem(), anyContainer(), random_.index(6)); break;
        default: edit.setType(anyItem(), oneOf(types_));
        }
    }

    void changeItem(Transaction& edit)
    {
        const Item& item = anyItem();
        switch (random_.index(7)) {
        case 0: edit.set(item, "name", anyText()); break;
        case 1: edit.set(item, chance(1, 2) ? "visible" : "locked", chance(1, 2)); break;
        case 2: edit.setPath(item, anyPath()); break;
        case 3: edit.transform(item, Affine::rotation(random_.real(-3, 3), random_.point())); break;
        case 4: {
            const std::size_t segments[] = {random_.index(5), random_.index(5)};
            edit.transform(item, Affine::scaling({0.9, 1.1}), segments);
            break;
        }
        default: {
            const auto specs = tableOf(item).specs();
            if (specs.empty()) return edit.select(item);
            const PropertySpec& spec = specs[random_.index(specs.size())];
            edit.set(item, spec.id, anyValue(spec));
        }
        }
    }

    void changeEffects(Transaction& edit)
    {
        static const std::vector<std::string> effects{"tint", "box-body", "hook", "absent"};
        const Item& item = anyItem();
        const std::size_t index = random_.index(item.effects().size() + 1);
        switch (item.effects().size() > 5 ? 1 : random_.index(4)) {
        case 0: edit.addEffect(item, oneOf(effects)); break;
        case 1: edit.removeEffect(item, index); break;
        case 2: edit.moveEffect(item, index, random_.index(3)); break;
        default: {
            if (index == item.effects().size() || chance(1, 5))
                return edit.setEffect(item, index, "visible", chance(1, 2));
            const auto specs = catalog.effect(item.effects()[index].type)->properties().specs();
            if (specs.empty()) return;
            const PropertySpec& spec = specs[random_.index(specs.size())];
            edit.setEffect(item, index, spec.id, anyValue(spec));
        }
        }
    }

    void changeScene(Transaction& edit)
    {
        if (chance(1, 4)) {
            MaterialTable materials(anyText());
            materials.setPair(0, 0, {random_.real(0, 1), 0.5, chance(1, 2)});
            return edit.setMaterials(std::move(materials));
        }
        const auto specs = Scene::settingsTable().specs();
        const PropertySpec& spec = specs[random_.index(specs.size())];
        edit.setScene(spec.id, anyValue(spec));
    }

    const Item& anySymbol()
    {
        const auto symbols = symbolsOf(scene);
        if (symbols.empty()) throw Failure(Error("no symbol yet"));
        return *oneOf(symbols);
    }
    const Item& anyInstance()
    {
        const auto instances = instancesOf(scene, anySymbol());
        if (instances.empty()) throw Failure(Error("no instance"));
        return *oneOf(instances);
    }
    Affine anyPlacement()
    {
        if (chance(1, 2)) return Affine::translation(random_.point());
        Affine placement = Affine::rotation(random_.real(-3, 3), random_.point());
        placement.linear() *= chance(1, 10) ? 0 : random_.real(0.5, 2);
        return placement;
    }
    void changeSymbols()
    {
        auto edit = items().begin("Symbols");  // several changes: what fails half-way is taken back as a whole
        changeSymbols(edit);
        edit.commit();
    }
    void changeSymbols(Transaction& edit)
    {
        switch (items().itemCount() > kMostItems ? 2 + random_.index(5) : random_.index(6)) {
        case 0: {
            if (symbolsOf(scene).size() > 4) return;
            const Item* item = &anyItem();
            if (item->parent() && item->id() != kSymbolsId) createSymbol(edit, scene, std::span(&item, 1));
            break;
        }
        case 1: placeSymbol(edit, anySymbol(), anyContainer(), anyPlacement()); break;
        case 2: setPlacement(edit, anyInstance(), anyPlacement()); break;
        case 3: swapSymbol(edit, anyInstance(), anySymbol()); break;
        case 4: detachInstance(edit, anyInstance()); break;
        case 5: edit.remove(anyInstance()); break;
        default: removeSymbol(edit, anySymbol());
        }
    }

    /// One operation; what cannot be done is refused and leaves the scene as it was.
    void operate(Transaction& edit)
    {
        ++operations_;
        const bool look = chance(1, 16);
        const std::uint64_t before = look ? scene.hash() : 0;
        try {
            switch (random_.index(11)) {
            case 10: return changeSymbols();
            case 0:
            case 1:
            case 2: return changeTree(edit);
            case 3:
            case 4:
            case 5:
            case 6: return changeItem(edit);
            case 7:
            case 8: return changeEffects(edit);
            default: return changeScene(edit);
            }
        } catch (const Failure&) {
            ++refused_;
            if (look) expectHash(before, "a refused operation");
        }
    }

    void expectHash(std::uint64_t expected, const char* after)
    {
        ASSERT_EQ(scene.hash(), expected) << "after " << after << ", operation " << operations_;
    }

    void nest(Transaction& edit, int depth)
    {
        const std::uint64_t before = scene.hash();
        const auto selection = items().selection();
        try {
            auto inner = items().begin("Inner");
            fill(inner, depth + 1);
            if (chance(1, 3)) {
                inner.restart();
                expectHash(before, "a restart");
            }
            if (chance(1, 3)) throw std::runtime_error("a helper fails");
            if (chance(1, 2)) return inner.commit();
        } catch (const std::runtime_error&) {
            EXPECT_TRUE(edit.isOpen());
        }
        ASSERT_EQ(scene.hash(), before);
        ASSERT_EQ(items().selection(), selection);
    }

    void fill(Transaction& edit, int depth)
    {
        for (std::size_t left = 1 + random_.index(9); left > 0; --left) {
            operate(edit);
            if (depth < 3 && chance(1, 40)) nest(edit, depth);
            if (HasFatalFailure()) return;
        }
    }

    // --- transactions and the model

    std::size_t place() { return history().forgotten() + history().position(); }

    void remember()
    {
        log_.resize(place() - logBase_ + 1);  // what was undone is forgotten
        log_.back() = scene.hash();
        while (logBase_ < history().forgotten()) log_.pop_front(), ++logBase_;
    }
    void expectRemembered(const char* after)
    {
        ASSERT_EQ(scene.hash(), log_[place() - logBase_]) << "after " << after << ", operation " << operations_;
    }

    void transact()
    {
        static const std::vector<std::string> keys{"", "", "", "drag", "slider"};
        const std::size_t stepsBefore = history().size();
        auto edit = items().begin("Edit");
        fill(edit, 0);
        if (HasFatalFailure()) return;
        if (chance(1, 10)) edit.restart(), fill(edit, 0);
        if (chance(1, 8)) {
            edit.rollback();
            ASSERT_EQ(history().size(), stepsBefore);
            return expectRemembered("a rollback");
        }
        const bool nothing = edit.isEmpty();
        edit.commit(oneOf(keys));
        nothing ? expectRemembered("nothing") : remember();
    }

    static std::string kindAndText(const Value& value)
    {
        return value.text() + " (kind " + std::to_string(static_cast<int>(value.kind())) + ")";
    }
    static std::string firstDifference(const Item& a, const Item& b)
    {
        const std::string name = "item " + std::to_string(b.id().value) + " '" + b.name() + "': ";
        if (a.id() != b.id() || a.type() != b.type() || a.name() != b.name())
            return name + "is " + std::to_string(a.id().value) + " " + a.type() + " '" + a.name() + "' in the file";
        if (a.visible() != b.visible() || a.locked() != b.locked()) return name + "flags";
        if (a.path().text() != b.path().text()) return name + a.path().text() + " and " + b.path().text();
        for (const auto& [id, value] : b.properties().entries())
            if (a.property(id) != value)
                return name + a.type() + " " + id + " is " + kindAndText(value) + ", in the file " +
                       kindAndText(a.property(id).value_or("none"));
        if (a.properties() != b.properties()) return name + "properties";
        if (!std::ranges::equal(a.effects(), b.effects())) return name + "effects";
        if (a.children().size() != b.children().size()) return name + "number of members";
        for (std::size_t i = 0; i < a.children().size(); ++i)
            if (std::string text = firstDifference(*a.children()[i], *b.children()[i]); !text.empty())
                return name + "\n" + text;
        return "";
    }

    /// A file gives back what is in memory bit by bit, so the instances are what their symbols make of them.
    void expectExactInstances()
    {
        std::vector<FormatNote> notes;
        const auto read = readSceneText(writeSceneText(scene), "edits.scene", readBack_, catalog, notes);
        ASSERT_TRUE(read) << read.error().message << " after operation " << operations_;
        ASSERT_EQ((*read)->hash(), scene.hash())
            << "after operation " << operations_ << ": " << firstDifference((*read)->root(), scene.root())
            << firstDifference(*(*read)->items().find(kSymbolsId), *items().find(kSymbolsId));
        withInstances_ += !symbolsOf(scene).empty();
    }

    void travel()
    {
        if (chance(1, 20)) {
            history().goTo(random_.index(history().size() + 1));
            return expectRemembered("a jump");
        }
        for (std::size_t left = 1 + random_.index(6); left > 0; --left) {
            chance(3, 5) ? history().undo() : history().redo();
            ASSERT_NO_FATAL_FAILURE(expectRemembered("undo or redo"));
        }
    }

    static std::uint64_t seed()
    {
        const char* wanted = std::getenv("JET_TEST_SEED");
        return wanted ? std::strtoull(wanted, nullptr, 10) : 20261125;
    }

    test::Random random_{seed()};
    std::vector<std::string_view> types_;
    std::vector<const Item*> everything_;
    std::deque<std::uint64_t> log_{scene.hash()};  // by place in the history
    std::size_t logBase_ = 0;
    int operations_ = 0, refused_ = 0, withInstances_ = 0;
    EventsCenter readBack_;
};

TEST_F(RandomEdits, AMillionOperationsLeadBackToWhatWas)
{
    history().setMemoryLimit(100'000);  // so that the oldest steps are forgotten, too
    while (operations_ < kOperations) {
        ASSERT_NO_FATAL_FAILURE(transact());
        if (chance(1, 4)) {
            ASSERT_NO_FATAL_FAILURE(travel());
        }
        if (chance(1, 5)) {
            ASSERT_NO_FATAL_FAILURE(expectExactInstances());
        }
        if (chance(1, 50)) history().markClean();
        if (chance(1, 10)) items().query(Box({-50, -50}, {50, 50}));  // keeps the index alive and its edits tested
    }
    EXPECT_GT(history().forgotten(), 100u);
    EXPECT_GT(withInstances_, 1000);
    EXPECT_GT(refused_, kOperations / 100) << "what is refused is a part of the test";
    EXPECT_LT(refused_, kOperations / 2);
    std::vector<const Item*> painted;
    scene.root().walk([&](const Item& item) {
        if (item.shown() && !item.path().isEmpty()) painted.push_back(&item);
    });
    EXPECT_EQ(items().query(Box({-1e12, -1e12}, {1e12, 1e12})), painted);
}

}  // namespace
}  // namespace jet
