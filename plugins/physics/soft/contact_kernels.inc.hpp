// The kernels of contact_kernels.hpp, included once by the file of each instruction set, in a namespace of its own,
// after contact_lanes.inc.hpp.

namespace {

constexpr float kTouchSlops = 4;  // kTouchDepth of contact_point.hpp
constexpr float kIdleSlops = 5, kMostIdle = 8, kFarIdle = 6;
constexpr float kMostDrift = 1;  // slops an acting contact moves before it is looked at again
constexpr float kPushLengthsPerSecond = 4, kSlopsPerLength = 500, kMostLever = 2;  // as of contact_solver.cpp
constexpr float kYields = 10;                                                      // kYieldSlops of contact_point.hpp

/// Out of the wall, and how far the particle is along that. Units.
struct Outward {
    Eight x, y, separation;
    Bits round;  // a thick border is round where two of its walls meet: there the corner itself is what is touched
};

JET_INLINE Outward outward(const ContactBlock& c, const Offsets& at, const Eight& along, const Eight& inverse)
{
    const Eight zero{}, side = get(c.side), thickness = get(c.thickness);
    const Eight x = -at.edgeY * side * inverse, y = at.edgeX * side * inverse, height = at.x * x + at.y * y;
    const Bits thick = thickness > zero;
    if (bits(thick) == 0) return {x, y, height, thick};
    const Eight distance = root(at.x * at.x + at.y * at.y);
    const Bits round = thick & (along < zero) & (height > zero) & (distance > all(1e-12F)) & ~get(c.inside);
    return {choose(round, at.x / distance, x), choose(round, at.y / distance, y),
            choose(round, distance, height) - thickness, round};
}

/// For how many substeps those that do not act need not be looked at: what is far, and slow for that, may wait.
/// `beside`: units beyond an end of the wall; `passing`: units / s along it.
JET_INLINE std::uint8_t idleFor(ContactBlock& c, const Bits& active, const Eight& separation, const Eight& approach,
                                const Eight& beside, const Eight& passing, float h)
{
    const Eight slop = get(c.slop), longest = all(kMostIdle);
    const Eight above = (separation - kIdleSlops * slop) / (4 * size(approach) * h + slop);
    const Eight aside = (beside - kIdleSlops * slop) / (4 * passing * h + slop);
    const Bits waits = (get(c.side) != Eight{}) & ~active;
    const Eight wait = choose(waits, least(most(above, aside), longest), longest);
    put(c.far, (wait >= all(kFarIdle)) & ~active);
    // Without a branch: it would be guessed wrong often, and stop the next look.
    return static_cast<std::uint8_t>(
        _mm_cvttss_si32(_mm_max_ss(_mm_set_ss(leastOf(wait, kMostIdle)), _mm_setzero_ps())));
}

/// What an impulse there changes the velocity of one of the three particles by at most, 1 / mass.
JET_INLINE Eight reaction(const ContactBlock& c, const Eight& place)
{
    return most(get(c.invPoint), most((1.0F - place) * get(c.invFirst), place * get(c.invSecond)));
}

/// The impulses carried over move no particle faster at the new place than twice what they did at the old one.
JET_INLINE void bear(ContactBlock& c, const Eight& place)
{
    const Eight now = reaction(c, place), share = least(all(1), kMostLever * reaction(c, get(c.along)) / now);
    const Bits known = now > Eight{};
    put(c.normalImpulse, choose(known, share * get(c.normalImpulse), get(c.normalImpulse)));
    put(c.tangentImpulse, choose(known, share * get(c.tangentImpulse), get(c.tangentImpulse)));
}

/// What an impulse changes the velocities of the three particles by. In double, so that momentum is kept.
JET_INLINE void weigh(ContactBlock& c, const double* inverseMass)
{
    for (int i = 0; i < kWide; ++i) {
        const auto along = static_cast<double>(c.along[i]);
        c.ofPoint[i] = inverseMass[c.point[i]];
        c.ofFirst[i] = inverseMass[c.first[i]] * (along - 1);
        c.ofSecond[i] = inverseMass[c.second[i]] * -along;
    }
}

JET_INLINE void look(ContactBlock& c, ContactHead& head, const Particles& particles, const ContactStep& step)
{
    const Offsets at = offsets(particles.position, c), moving = offsets(particles.velocity, c);
    const Eight zero{}, one = all(1), far = all(1e30F), slop = get(c.slop), thickness = get(c.thickness);
    const Eight squared = at.edgeX * at.edgeX + at.edgeY * at.edgeY;
    const Bits valid = (squared > all(1e-24F)) & (get(c.side) != zero);
    const Eight length = root(squared), inverse = where(valid, one / length), inverseSquare = inverse * inverse;
    const Eight along = (at.x * at.edgeX + at.y * at.edgeY) * inverseSquare;
    const Eight place = least(most(along, zero), one);
    const Outward out = outward(c, at, along, inverse);

    const Eight relativeX = moving.x - place * moving.edgeX, relativeY = moving.y - place * moving.edgeY;
    const Eight approach = relativeX * out.x + relativeY * out.y;
    const Eight slide = (relativeX * at.edgeX + relativeY * at.edgeY) * inverseSquare;

    const Bits front = out.separation > zero, thick = thickness > zero, inside = get(c.inside);
    const Eight come = -approach * step.h;
    const Bits comes = come > zero, late = front & (out.separation > come + come + kTouchSlops * slop);
    const Eight part = least(one, choose(comes, out.separation / come, one));
    const Eight there = along + where(front & comes, slide * step.h * part);
    const Eight firstReach = choose(thick, where(out.round, far), get(c.firstReach));
    const Eight secondReach = where(~thick, get(c.secondReach));
    const Bits off = (there * length < -firstReach) | ((one - there) * length < -secondReach);
    const Bits behind = (out.separation + thickness < -kTouchSlops * slop) & ~get(c.engaged);
    const Bits met = valid & ~late & ~off & ~behind, active = met | (valid & inside);

    const Eight beside = choose(thick, (along - one) * length, most(-along, along - one) * length);
    head.idle = idleFor(c, active, out.separation, approach, beside, size(slide) * length, step.h);
    head.bounces = head.drifted = head.elastic = false;
    if (head.uneven) bear(c, place);
    put(c.along, place);
    const bool acted = head.any;
    head.any = bits(active) != 0;
    put(c.normalImpulse, where(active, get(c.normalImpulse)));  // those not in use yet go on from a neighbouring wall
    put(c.tangentImpulse, where(active, get(c.tangentImpulse)));
    if (!head.any && !acted) return;

    put(c.normalX, out.x), put(c.normalY, out.y), put(c.separation, out.separation), put(c.approach, approach);
    put(c.engaged, get(c.engaged) | met), put(c.active, active), put(c.drift, zero);
    head.elastic = bits(active & (get(c.restitution) > zero)) != 0;
    const Eight rest = one - place;
    const Eight give = get(c.invPoint) + rest * rest * get(c.invFirst) + place * place * get(c.invSecond);
    put(c.mass, where(give > zero, one / give));
    weigh(c, particles.inverseMass);
}

/// First finds which blocks there is something to look at in this substep, without branches. What acts keeps its
/// direction and its place on the wall until it has moved so far that they have changed.
std::size_t refresh(const ContactBlocks& of, const Particles& particles, const ContactStep& step)
{
    std::size_t due = 0, acting = 0;
    for (std::size_t i = 0; i < of.count; ++i) {
        ContactHead& head = of.heads[i];
        of.acting[due] = static_cast<std::uint32_t>(i);
        due += head.idle == 0 || head.drifted;
        head.idle -= head.idle != 0;
    }
    for (std::size_t k = 0; k < due; ++k) look(of.blocks[of.acting[k]], of.heads[of.acting[k]], particles, step);
    for (std::size_t i = 0; i < of.count; ++i) {
        of.acting[acting] = static_cast<std::uint32_t>(i);
        acting += of.heads[i].any;
    }
    return acting;
}

/// How fast the particles pass the walls: apart, and along them.
struct Passing {
    Eight apart, along;
};
JET_INLINE Passing passing(const ContactBlock& c, const Offsets& moving)
{
    const Eight place = get(c.along), normalX = get(c.normalX), normalY = get(c.normalY);
    const Eight x = moving.x - place * moving.edgeX, y = moving.y - place * moving.edgeY;
    return {x * normalX + y * normalY, y * normalX - x * normalY};
}

void meet(const ContactBlocks& of, const Particles& particles, float restSpeed)
{
    for (std::size_t k = 0; k < of.actingCount; ++k) {
        ContactHead& head = of.heads[of.acting[k]];
        if (!head.elastic) continue;
        ContactBlock& c = of.blocks[of.acting[k]];
        const Eight approach = passing(c, offsets(particles.velocity, c)).apart;
        put(c.approach, approach);
        head.bounces = bits(get(c.active) & (get(c.restitution) > Eight{}) & (approach < all(-restSpeed))) != 0;
    }
}

void warm(const ContactBlocks& of, const Particles& particles)
{
    for (std::size_t k = 0; k < of.actingCount; ++k) {
        const ContactBlock& c = of.blocks[of.acting[k]];
        exert(c, particles, get(c.normalImpulse), get(c.tangentImpulse));
    }
}

template <bool push>
JET_INLINE void solveOne(ContactBlock& c, ContactHead& head, const Particles& particles, const ContactStep& step)
{
    const Eight zero{}, one = all(1), mass = get(c.mass);
    const Offsets moving = offsets(particles.velocity, c);
    const Passing speed = passing(c, moving);
    Eight separation = get(c.separation);
    if constexpr (!push) {
        separation = separation + step.h * speed.apart;
        put(c.separation, separation);
        const Eight drift = get(c.drift) + step.h * (size(speed.along) + size(moving.edgeX) + size(moving.edgeY));
        put(c.drift, drift);
        head.drifted = bits(get(c.active) & (drift > kMostDrift * get(c.slop))) != 0;
    }
    const Bits apart = separation > zero, active = get(c.active);
    const Eight before = get(c.normalImpulse), tangentBefore = get(c.tangentImpulse);
    Eight wanted = where(apart, separation * step.inverseH);  // speed that closes the gap
    if constexpr (push) {
        const Bits still = get(c.still);
        const Eight slop = get(c.slop), rate = choose(still, all(step.still.biasRate), all(step.moving.biasRate));
        Eight fastest = -kPushLengthsPerSecond * kSlopsPerLength * slop;
        if (head.uneven) fastest = fastest * least(one, kMostLever / (mass * reaction(c, get(c.along))));
        const Eight bias = choose(apart, wanted, most(rate * least(zero, separation + slop), fastest));
        Eight massScale = choose(still, all(step.still.massScale), all(step.moving.massScale));
        Eight impulseScale = choose(still, all(step.still.impulseScale), all(step.moving.impulseScale));
        const Eight deep = -(separation + slop), limit = kYields * slop;
        const Bits hard = active & get(c.engaged) & (deep > limit);
        if (bits(hard) != 0) {
            const Eight yields = choose(hard, most(zero, all(2.0F) - deep / limit), one);
            massScale = massScale + (one - yields) * (one - massScale), impulseScale = yields * impulseScale;
        }
        massScale = choose(apart, one, massScale), impulseScale = where(~apart, impulseScale);
        wanted = -mass * massScale * (speed.apart + bias) - impulseScale * before;
    } else {
        wanted = -mass * (speed.apart + wanted);
    }
    const Eight normal = where(active, most(before + wanted, zero)), grip = get(c.friction) * normal;
    const Eight tangent = where(active, most(least(tangentBefore - mass * speed.along, grip), -grip));
    exert(c, particles, normal - before, tangent - tangentBefore);
    put(c.normalImpulse, normal), put(c.tangentImpulse, tangent);
    if constexpr (!push) put(c.stepImpulse, get(c.stepImpulse) + normal);
}

template <bool push>
void solveAll(const ContactBlocks& of, const Particles& particles, const ContactStep& step)
{
    for (std::size_t k = 0; k < of.actingCount; ++k)
        solveOne<push>(of.blocks[of.acting[k]], of.heads[of.acting[k]], particles, step);
}

void solve(const ContactBlocks& of, const Particles& particles, const ContactStep& step, bool push)
{
    push ? solveAll<true>(of, particles, step) : solveAll<false>(of, particles, step);
}

void bounce(const ContactBlocks& of, const Particles& particles, float restSpeed)
{
    const Eight zero{};
    for (std::size_t k = 0; k < of.actingCount; ++k) {
        if (!of.heads[of.acting[k]].bounces) continue;
        ContactBlock& c = of.blocks[of.acting[k]];
        const Eight before = get(c.normalImpulse), restitution = get(c.restitution), approach = get(c.approach);
        const Bits thrown = get(c.active) & (restitution > zero) & (approach < all(-restSpeed)) & (before > zero);
        const Eight missing = passing(c, offsets(particles.velocity, c)).apart + restitution * approach;
        const Eight impulse = choose(thrown, most(before - get(c.mass) * missing, zero), before);
        exert(c, particles, impulse - before, zero);
        put(c.stepImpulse, get(c.stepImpulse) + (impulse - before));
        put(c.normalImpulse, impulse);
    }
}

NearResult survey(const WallBlock* blocks, std::size_t count, const NearQuery& query, std::uint8_t* near)
{
    const Eight zero{}, one = all(1), x = all(query.x), y = all(query.y);
    NearResult result;
    unsigned crossings = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const WallBlock& w = blocks[i];
        near[i] = 0;
        const bool level = query.y >= w.top && query.y <= w.bottom && query.x <= w.right;
        const bool beside = query.x >= w.left - query.reach && query.x <= w.right + query.reach &&
                            query.y >= w.top - query.reach && query.y <= w.bottom + query.reach;
        if (!level && !beside) continue;
        const Eight wallX = get(w.x), wallY = get(w.y), edgeX = get(w.edgeX), edgeY = get(w.edgeY);
        const Eight offX = x - wallX, offY = y - wallY;
        if (level) {
            const Bits straddles = (wallY > y) ^ (wallY + edgeY > y);
            crossings += static_cast<unsigned>(__builtin_popcount(bits(straddles & (x < wallX + offY * get(w.slope)))));
        }
        if (!beside) continue;
        const Eight inverseSquare = get(w.inverseSquare);
        const Eight raw = (offX * edgeX + offY * edgeY) * inverseSquare, over = raw - one;
        const Eight along = least(most(raw, zero), one);
        const Bits past = (over > zero) & (over * over > query.slide * query.slide * inverseSquare);
        const Eight awayX = offX - along * edgeX, awayY = offY - along * edgeY;
        const Eight away = awayX * awayX + awayY * awayY;
        const Bits front = offX * get(w.normalX) + offY * get(w.normalY) >= all(-query.behind);
        near[i] = static_cast<std::uint8_t>(bits(front & ~past & (away <= all(query.reach * query.reach))));
        result.onSurface |= bits(front & (away <= all(query.behind * query.behind))) != 0;
    }
    result.inside = (crossings & 1) != 0;
    return result;
}

}  // namespace

const ContactKernels contacts{&refresh, &meet, &warm, &solve, &bounce, &survey};
