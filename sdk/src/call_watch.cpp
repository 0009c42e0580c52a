#include "open_transactions.hpp"

#include <jet/call_watch.hpp>
#include <jet/items_center.hpp>

#include <algorithm>
#include <atomic>
#include <vector>

namespace jet {

namespace {

std::atomic<CallWatch*> theWatch{nullptr};

// Asked at each guarded call: the counter is apart from the list, so that asking needs no initialisation check.
__attribute__((tls_model("initial-exec"))) thread_local constinit std::size_t openCount = 0;

struct Open {
    ItemsCenter* center;
    std::string label;
    void (*rollBack)(ItemsCenter&);
};

std::vector<Open>& openHere()
{
    thread_local std::vector<Open> list;
    return list;
}

auto lastOf(const ItemsCenter& center)
{
    auto& list = openHere();
    return std::find_if(list.rbegin(), list.rend(), [&](const Open& open) { return open.center == &center; });
}

}  // namespace

CallWatch::~CallWatch() = default;
void CallWatch::set(CallWatch* watch) { theWatch = watch; }
CallWatch* CallWatch::get() { return theWatch.load(std::memory_order_acquire); }

OpenMark::OpenMark(ItemsCenter& center, const std::string& label, void (*rollBack)(ItemsCenter&)) : center_(&center)
{
    openHere().push_back({center_, label, rollBack});
    ++openCount;
}

void OpenMark::close()
{
    if (!center_) return;
    const auto found = lastOf(*std::exchange(center_, nullptr));
    if (found == openHere().rend()) return;  // closed on another thread: a scene that was handed over
    openHere().erase(std::next(found).base());
    --openCount;
}

std::size_t openTransactionCount() { return openCount; }

std::string openTransactionLabel(const ItemsCenter& items)
{
    const auto found = lastOf(items);
    return found == openHere().rend() ? std::string() : found->label;
}

std::string abandonTransactions(std::size_t count)
{
    std::string first;
    auto& list = openHere();
    while (list.size() > count) {
        const std::size_t before = list.size();
        first = list.back().label;
        const Open last = list.back();
        last.rollBack(*last.center);
        if (list.size() == before) break;  // cannot be: that closes it
    }
    return first;
}

}  // namespace jet
