// Detection: predicts where bodies may come, finds pairs, collides them both ways, and carries the impulses of contacts
// that persist over to the new ones. Says when bodies have left their predictions, so that it must be done again.
#pragma once

#include "narrow_phase.hpp"
#include "soft/cloud_kernels.hpp"

namespace jet::physics {

class ContactFinder {
public:
    void use(const soft::CloudKernels& kernels) { clouds_ = &kernels; }

    /// Which bodies may meet in the coming `dt` seconds: nearPairs(). `first`: of the step; points and readings are
    /// those of the nodes then.
    void seek(State&, const WorldSettings&, double dt, bool first, StepStats&);
    /// Then the contacts that serve those seconds, in ascending order of (point, wall). Those of what rests are kept.
    void find(State&, const WorldSettings&, double dt, std::vector<ContactPoint>& contacts, StepStats&);
    /// Appends those contacts the last find() dropped that had pushed in this step: they are over, but they happened.
    void collectEnded(std::span<const ContactPoint> contacts, std::vector<ContactPoint>& ended) const;
    /// Has a body moved, since find(), further from its prediction than its contacts allow for? `elapsed`: seconds.
    bool strayed(const State&, double elapsed);

    /// Pairs that joints keep from colliding; ascending, the smaller handle first.
    void exclude(std::vector<std::pair<Index, Index>> pairs) { excluded_ = std::move(pairs); }

    /// Units the particles of a body may stray from their predictions, in all of the time find() was asked for, while
    /// it meets nothing, not even itself; 0: it may meet something. As of the last find().
    double freedomOf(Index body) const;

    // Of the last find():
    const std::vector<Motion>& motions() const { return motions_; }
    /// Calls visit(body, body) for each pair with a body that is not simple, and different bodies.
    template <class Visit>
    void eachNear(Visit&& visit) const
    {
        for (const std::vector<BodyPair>* list : {&pairs_, &softPairs_})
            for (const BodyPair& pair : *list)
                if (pair.a != pair.b) visit(pair.a, pair.b);
    }
    /// Was the body's reach made wider, for what may hit it?
    bool expectsHit(Index body) const { return body < motions_.size() && motions_[body].surprise > 0; }
    /// Nothing may meet.
    void clear() { pairs_.clear(), softPairs_.clear(); }
    /// Pairs with a body that is not simple, but for those of softPairs().
    const std::vector<BodyPair>& pairs() const { return pairs_; }
    /// [nodes] where they were; nothing where nothing could meet.
    std::span<const Vec2> positions() const { return lonely_ ? std::span<const Vec2>() : position_; }
    /// [bodies] units their particles are now, as of the last strayed(), from where the shape at rest has them, at
    /// most; infinite: unknown. Nothing where nothing could meet.
    std::span<const double> offs() const { return lonely_ ? std::span<const double>() : offs_; }
    /// Pairs that soft/contacts.hpp takes; ascending.
    const std::vector<BodyPair>& softPairs() const { return softPairs_; }

private:
    bool isSlow(const State&, const BodyPair&, double dt) const;
    void splitPairs(const State&, double dt);
    void keepResting(const State&, const WorldSettings&, std::span<const ContactPoint>,
                     std::vector<ContactPoint>&) const;
    bool expectHits(const State&, double dt);
    void readBorders(State&);
    void predict(const State&, const WorldSettings&, double dt);
    void predictBody(const State&, Index body, const WorldSettings&, double dt, Motion&, double& budget) const;
    void collidePairs(const State&, const WorldSettings&, double dt, std::span<const ContactPoint> previous,
                      std::vector<ContactPoint>& contacts);
    static void decideSide(const State&, Index platform, Index other, std::span<const ContactPoint> previous,
                           std::size_t first, std::vector<ContactPoint>& contacts);
    static void carryOver(const State&, std::span<const ContactPoint> previous, std::vector<ContactPoint>& contacts);

    const soft::CloudKernels* clouds_ = &soft::sse2::clouds;
    bool lonely_ = false;  // is there nothing that could meet?
    std::vector<Motion> motions_;
    std::vector<double> budgets_;            // [bodies] units a node may stray
    std::vector<double> offs_;               // [bodies] units
    std::vector<Vec2> position_, velocity_;  // [nodes] at the last find()
    Column<double> angle_{0}, omega_{0};
    std::vector<std::pair<Index, Index>> excluded_;
    std::vector<BodyPair> pairs_, softPairs_;
    std::vector<std::uint8_t> read_;  // [bodies] soft bodies whose corners and grid are as of this find()
    std::vector<ContactPoint> previous_;
};

}  // namespace jet::physics
