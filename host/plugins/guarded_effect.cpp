// Effects and item types under guard.
#include "guarded_object.hpp"

namespace jet::host {

namespace {

/// What a plugin's effect keeps between paints; it goes through the guard when it is dropped.
class GuardedState final : public EffectState {
public:
    GuardedState(Guard& guard, Plugin& plugin, std::unique_ptr<EffectState> inner, std::uint64_t version)
        : guard_(guard), plugin_(plugin), inner_(std::move(inner)), version_(version)
    {
    }
    ~GuardedState() override
    {
        guard_.destroy(plugin_, Callback::EffectStateDestroy, [&] { inner_.reset(); });
    }
    /// Null for another version of the effect than the one that made it.
    const EffectState* of(std::uint64_t version) const { return version == version_ ? inner_.get() : nullptr; }

private:
    Guard& guard_;
    Plugin& plugin_;
    std::unique_ptr<EffectState> inner_;
    std::uint64_t version_;
};

class GuardedEffect final : public Effect, GuardedObject<Effect, Callback::EffectDestroy> {
public:
    GuardedEffect(Guard& guard, Plugin& plugin, std::shared_ptr<Effect> effect)
        : GuardedObject(guard, plugin, std::move(effect))
    {
        readTable();
    }
    void renew(std::shared_ptr<Effect> effect)
    {
        renewInner(std::move(effect));
        ++version_;
        readTable();
    }

    const PropertyTable& properties() const override { return table_.table(); }
    std::string rejects(const Item& item) const override
    {
        return ask(
            Callback::EffectRejects, [&](Effect& e) { return e.rejects(item); },
            "the plugin " + plugin_.manifest.name + " failed");
    }
    // A Failure here is the transaction's: it takes the effect back and tells why. Anything else is the plugin's fault,
    // too.
    void applied(Transaction& edit, const Item& item) const override
    {
        std::optional<Error> refusal;
        const bool fine = tell(Callback::EffectApplied, [&](Effect& e) {
            try {
                e.applied(edit, item);
            } catch (const Failure& failure) {
                refusal = failure.error();
            }
        });
        if (refusal) throw Failure(*refusal);
        if (!fine)
            throw Failure(
                Error("the plugin " + plugin_.title() + " failed; the effect was not applied: " + plugin_.reason));
    }
    std::unique_ptr<EffectState> update(const EffectInput& input) const override
    {
        auto state = ask(
            Callback::EffectUpdate, [&](Effect& e) { return e.update(input); }, std::unique_ptr<EffectState>());
        if (!state) return nullptr;
        return std::make_unique<GuardedState>(guard_, plugin_, std::move(state), version_);
    }
    void paint(const EffectInput& input, const EffectState* state, PaintPurpose purpose,
               Painter& painter) const override
    {
        const auto* kept = static_cast<const GuardedState*>(state);  // from update()
        tell(Callback::EffectPaint,
             [&](Effect& e) { e.paint(input, kept ? kept->of(version_) : nullptr, purpose, painter); });
    }
    bool wantsLiveBody() const override
    {
        return ask(
            Callback::EffectWantsLiveBody, [](Effect& e) { return e.wantsLiveBody(); }, false);
    }
    // A Failure is a word about this item (a path without an inside), not a fault of the plugin.
    std::optional<BodyDef> buildBody(const EffectInput& input, const BodyCommon& common) const override
    {
        std::optional<Error> refusal;
        std::optional<BodyDef> built;
        tell(Callback::EffectBuildBody, [&](Effect& e) {
            try {
                built = e.buildBody(input, common);
            } catch (const Failure& failure) {
                refusal = failure.error();
            }
        });
        if (refusal) throw Failure(*refusal);
        return built;
    }

private:
    // What is gone keeps the table it had.
    void readTable()
    {
        if (!inner_) return;
        table_.keep(ask(
            Callback::EffectProperties, [](Effect& e) { return &e.properties(); },
            static_cast<const PropertyTable*>(nullptr)));
    }

    KeptTable table_;
    std::uint64_t version_ = 0;
};

class GuardedItemType final : public ItemType, GuardedObject<ItemType, Callback::ItemTypeDestroy> {
public:
    GuardedItemType(Guard& guard, Plugin& plugin, std::shared_ptr<ItemType> type)
        : GuardedObject(guard, plugin, std::move(type))
    {
        readTable();
    }
    void renew(std::shared_ptr<ItemType> type)
    {
        renewInner(std::move(type));
        readTable();
    }

    const PropertyTable& properties() const override { return table_.table(); }
    std::string label() const override
    {
        return ask(
            Callback::ItemTypeLabel, [](ItemType& t) { return t.label(); }, std::string("Item"));
    }
    void paint(const Item& item, const Path& path, PaintPurpose purpose, Painter& painter) const override
    {
        tell(Callback::ItemTypePaint, [&](ItemType& t) { t.paint(item, path, purpose, painter); });
    }
    void build(const Item& item, WorldBuilder& builder) const override
    {
        tell(Callback::ItemTypeBuild, [&](ItemType& t) { t.build(item, builder); });
    }

private:
    // What is gone keeps the table it had.
    void readTable()
    {
        if (!inner_) return;
        table_.keep(ask(
            Callback::ItemTypeProperties, [](ItemType& t) { return &t.properties(); },
            static_cast<const PropertyTable*>(nullptr)));
    }

    KeptTable table_;
};

}  // namespace

std::shared_ptr<Effect> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Effect> effect)
{
    return std::make_shared<GuardedEffect>(guard, plugin, std::move(effect));
}
std::shared_ptr<ItemType> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<ItemType> type)
{
    return std::make_shared<GuardedItemType>(guard, plugin, std::move(type));
}
void renew(Effect& guarded, std::shared_ptr<Effect> effect)
{
    static_cast<GuardedEffect&>(guarded).renew(std::move(effect));
}
void renew(ItemType& guarded, std::shared_ptr<ItemType> type)
{
    static_cast<GuardedItemType&>(guarded).renew(std::move(type));
}

}  // namespace jet::host
