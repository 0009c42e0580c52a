// What the guarded contributions have in common. One that all users of a plugin share (an effect, a format, an engine)
// keeps its address when the plugin is reloaded: only what is inside is renewed.
#pragma once

#include "guarded.hpp"

namespace jet::host {

/// Base of a guarded object around the plugin's own T; `destroyed` is what its destructor is called in messages.
template <class T, Callback destroyed>
class GuardedObject {
public:
    GuardedObject(Guard& guard, Plugin& plugin, std::shared_ptr<T> inner)
        : guard_(guard), plugin_(plugin), inner_(std::move(inner))
    {
    }
    GuardedObject(const GuardedObject&) = delete;
    GuardedObject& operator=(const GuardedObject&) = delete;

    /// After a reload; null: the plugin does not offer it any more, or is being unloaded.
    void renewInner(std::shared_ptr<T> inner)
    {
        drop();
        inner_ = std::move(inner);
    }

protected:
    ~GuardedObject() { drop(); }

    /// Calls fn with the plugin's own object; `neutral` when there is none, or when it fails.
    template <class Fn, class R>
    R ask(Callback callback, Fn&& fn, R neutral) const
    {
        if (!inner_) [[unlikely]]
            return neutral;
        return guard_.call(
            plugin_, callback, [&]() -> R { return fn(*inner_); }, std::move(neutral));
    }
    /// False: failed.
    template <class Fn>
    bool tell(Callback callback, Fn&& fn) const
    {
        return ask(
            callback,
            [&](T& inner) {
                fn(inner);
                return true;
            },
            false);
    }
    Failure switchedOff() const
    {
        const std::string why = plugin_.reason.empty() ? "it does not offer this any more" : plugin_.reason;
        return Failure(Error("the plugin " + plugin_.title() + " was switched off: " + why));
    }

    Guard& guard_;
    Plugin& plugin_;
    std::shared_ptr<T> inner_;

private:
    void drop()
    {
        if (inner_) guard_.destroy(plugin_, destroyed, [&] { inner_.reset(); });
    }
};

/// A property table, copied: nobody then refers to memory of the plugin. Tables of earlier versions stay, since they
/// may still be referred to.
class KeptTable {
public:
    const PropertyTable& table() const { return tables_.empty() ? none() : *tables_.back(); }
    void keep(const PropertyTable* table)
    {
        tables_.push_back(table ? std::make_unique<PropertyTable>(*table) : std::make_unique<PropertyTable>());
    }

private:
    static const PropertyTable& none()
    {
        static const PropertyTable empty;
        return empty;
    }
    std::vector<std::unique_ptr<PropertyTable>> tables_;
};

/// For formats and runtimes: a Failure tells of the file or script, any other exception is the plugin's fault.
template <class R, class Fn>
R resultOf(Fn&& fn)
{
    try {
        return fn();
    } catch (const Failure& failure) {
        return failure.error();
    }
}

}  // namespace jet::host
