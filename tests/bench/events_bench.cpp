// EventsCenter beside Boost.Signals2 and QObject signals: 1,000 listeners, ten of them on the sender that posts. A
// sender of the peers is an object with its own signal, as one would write it with them.
#include "bench/summary.hpp"

#include <jet/events.hpp>

#include <boost/signals2/signal.hpp>

#include <QObject>

#include <memory>
#include <vector>

namespace {

constexpr int kSenders = 100, kListenersEach = 10;  // 1,000 listeners

struct Moved {
    static constexpr jet::EventType type{"bench.moved"};
    int by = 1;
};

}  // namespace

class QtSender final : public QObject {
    Q_OBJECT
public:
    void post(int by) { emit moved(by); }
signals:
    void moved(int by);
};

namespace {

void eventsCenter(benchmark::State& state)
{
    jet::EventsCenter events;
    std::vector<int> senders(kSenders);
    std::vector<jet::Subscription> subscriptions;
    std::int64_t heard = 0;
    for (const int& sender : senders)
        for (int i = 0; i < kListenersEach; ++i)
            subscriptions.push_back(events.subscribe<Moved>(&sender, [&heard](const Moved& e) { heard += e.by; }));
    for (auto _ : state) events.post(&senders[42], Moved{1});
    state.SetItemsProcessed(heard);
    if (heard != static_cast<std::int64_t>(state.iterations()) * kListenersEach)
        state.SkipWithError("not all were heard");
}
BENCHMARK(eventsCenter);

void boostSignals2(benchmark::State& state)
{
    std::vector<boost::signals2::signal<void(int)>> senders(kSenders);
    std::int64_t heard = 0;
    for (auto& sender : senders)
        for (int i = 0; i < kListenersEach; ++i) sender.connect([&heard](int by) { heard += by; });
    for (auto _ : state) senders[42](1);
    state.SetItemsProcessed(heard);
}
BENCHMARK(boostSignals2);

void qtSignals(benchmark::State& state)
{
    std::vector<std::unique_ptr<QtSender>> senders;
    QObject receiver;
    std::int64_t heard = 0;
    for (int s = 0; s < kSenders; ++s) {
        senders.push_back(std::make_unique<QtSender>());
        for (int i = 0; i < kListenersEach; ++i)
            QObject::connect(senders.back().get(), &QtSender::moved, &receiver, [&heard](int by) { heard += by; });
    }
    for (auto _ : state) senders[42]->post(1);
    state.SetItemsProcessed(heard);
}
BENCHMARK(qtSignals);

}  // namespace

int main(int argc, char** argv)
{
    return jet::bench::run(argc, argv, [](const jet::bench::Times& times, jet::bench::Summary& summary) {
        const auto perSecond = [&](const char* name) { return kListenersEach / (times.at(name) * 1e-9) / 1e6; };
        const double jet = perSecond("eventsCenter");
        summary.add("deliveries", jet, "million/s", 5, jet >= 5);
        summary.note("boost_signals2", perSecond("boostSignals2"), "million/s");
        summary.note("qt_signals", perSecond("qtSignals"), "million/s");
        summary.note("ratio_boost_signals2", jet / perSecond("boostSignals2"), "(above 1: JET is faster)");
        summary.note("ratio_qt_signals", jet / perSecond("qtSignals"), "(above 1: JET is faster)");
    });
}

#include "events_bench.moc"
