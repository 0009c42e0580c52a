// The kernels of contact_kernels.hpp, included once by the file of each instruction set, in a namespace of its own,
// after contact_lanes.inc.hpp.

namespace {

constexpr float kTouchSlops = 4;  // kTouchDepth of contact_point.hpp
constexpr float kIdleSlops = 8, kMostIdle = 8, kFarIdle = 6;
constexpr float kMostDrift = 1;  // slops an acting contact moves before it is looked at again
constexpr float kPushLengthsPerSecond = 4, kSlopsPerLength = 500;  // as of contact_solver.cpp

/// What decides how long those that do not act may be left alone: units beyond an end of the wall, and units / s along
/// it.
struct Aside {
    Eight beside, passing;
};

JET_INLINE Aside decide(ContactBlock& c, const Offsets& at, const Offsets& moving, const ContactStep& step)
{
    const Eight zero{}, one = all(1), far = all(1e30F), side = get(c.side), slop = get(c.slop);
    const Eight squared = at.edgeX * at.edgeX + at.edgeY * at.edgeY;
    const Bits valid = (squared > all(1e-24F)) & (side != zero);
    const Eight length = root(squared), inverse = where(valid, one / length), inverseSquare = inverse * inverse;
    const Eight wallX = -at.edgeY * side * inverse, wallY = at.edgeX * side * inverse;
    const Eight height = at.x * wallX + at.y * wallY;
    const Eight along = (at.x * at.edgeX + at.y * at.edgeY) * inverseSquare;
    const Eight place = least(most(along, zero), one);
    put(c.along, place);

    // A thick border is round where two of its walls meet: there the corner itself is what is touched.
    const Eight thickness = get(c.thickness);
    const Bits thick = thickness > zero, inside = get(c.inside);
    const Eight distance = root(at.x * at.x + at.y * at.y);
    const Bits round = thick & (along < zero) & (height > zero) & (distance > all(1e-12F)) & ~inside;
    const Eight outX = choose(round, at.x / distance, wallX), outY = choose(round, at.y / distance, wallY);
    const Eight separation = choose(round, distance, height) - thickness;
    put(c.normalX, outX), put(c.normalY, outY), put(c.separation, separation);

    const Eight relativeX = moving.x - place * moving.edgeX, relativeY = moving.y - place * moving.edgeY;
    const Eight approach = relativeX * outX + relativeY * outY;
    const Eight slide = (relativeX * at.edgeX + relativeY * at.edgeY) * inverseSquare;
    put(c.approach, approach);

    const Bits front = separation > zero;
    const Eight come = -approach * step.h;
    const Bits comes = come > zero, late = front & (separation > come + come + kTouchSlops * slop);
    const Eight part = least(one, choose(comes, separation / come, one));
    const Eight there = along + where(front & comes, slide * step.h * part);
    const Eight firstReach = choose(thick, where(round, far), get(c.firstReach));
    const Eight secondReach = where(~thick, get(c.secondReach));
    const Bits off = (there * length < -firstReach) | ((one - there) * length < -secondReach);
    const Bits behind = (separation + thickness < -kTouchSlops * slop) & ~get(c.engaged);
    const Bits met = valid & ~late & ~off & ~behind, active = met | (valid & inside);
    put(c.engaged, get(c.engaged) | met), put(c.active, active);

    const Eight rest = one - place;
    const Eight give = get(c.invPoint) + rest * rest * get(c.invFirst) + place * place * get(c.invSecond);
    put(c.mass, where(give > zero, one / give));
    put(c.normalImpulse, where(active, get(c.normalImpulse)));
    put(c.tangentImpulse, where(active, get(c.tangentImpulse)));
    return {choose(thick, (along - one) * length, most(-along, along - one) * length), size(slide) * length};
}

/// For how many substeps those that do not act need not be looked at: what is far, and slow for that, may wait.
JET_INLINE std::int32_t idleFor(ContactBlock& c, const Aside& aside, const ContactStep& step)
{
    const Eight slop = get(c.slop), longest = all(kMostIdle);
    const Eight above = (get(c.separation) - kIdleSlops * slop) / (4 * size(get(c.approach)) * step.h + slop);
    const Eight beside = (aside.beside - kIdleSlops * slop) / (4 * aside.passing * step.h + slop);
    const Bits waits = (get(c.side) != Eight{}) & ~get(c.active);
    const Eight wait = choose(waits, least(most(above, beside), longest), longest);
    put(c.far, (wait >= all(kFarIdle)) & ~get(c.active));
    const float shortest = leastOf(wait, kMostIdle);
    return shortest > 1 ? static_cast<std::int32_t>(shortest) : 0;
}

/// Is there nothing to look at in this substep? What acts keeps its direction and its place on the wall until it has
/// moved so far that they have changed.
JET_INLINE bool isAsItWas(ContactBlock& c)
{
    if (c.idle == 0) return false;
    --c.idle;
    return !c.any || bits(get(c.active) & (get(c.drift) > kMostDrift * get(c.slop))) == 0;
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

void refresh(ContactBlock* blocks, std::size_t count, const Particles& particles, const ContactStep& step)
{
    for (std::size_t i = 0; i < count; ++i) {
        ContactBlock& c = blocks[i];
        if (isAsItWas(c)) continue;
        const Aside aside = decide(c, offsets(particles.position, c), offsets(particles.velocity, c), step);
        c.any = bits(get(c.active)) != 0;
        c.elastic = bits(get(c.active) & (get(c.restitution) > Eight{})) != 0;
        c.bounces = false;
        c.idle = idleFor(c, aside, step);
        put(c.drift, Eight{});
        if (c.any) weigh(c, particles.inverseMass);
    }
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

void meet(ContactBlock* blocks, std::size_t count, const Particles& particles, float restSpeed)
{
    for (std::size_t i = 0; i < count; ++i) {
        ContactBlock& c = blocks[i];
        if (!c.any || !c.elastic) continue;
        const Eight approach = passing(c, offsets(particles.velocity, c)).apart;
        put(c.approach, approach);
        c.bounces = bits(get(c.active) & (get(c.restitution) > Eight{}) & (approach < all(-restSpeed))) != 0;
    }
}

void warm(const ContactBlock* blocks, std::size_t count, const Particles& particles)
{
    for (std::size_t i = 0; i < count; ++i)
        if (blocks[i].any) exert(blocks[i], particles, get(blocks[i].normalImpulse), get(blocks[i].tangentImpulse));
}

template <bool push>
JET_INLINE void solveOne(ContactBlock& c, const Particles& particles, const ContactStep& step)
{
    const Eight zero{}, one = all(1), mass = get(c.mass);
    const Offsets moving = offsets(particles.velocity, c);
    const Passing speed = passing(c, moving);
    Eight separation = get(c.separation);
    if constexpr (!push) {
        separation = separation + step.h * speed.apart;
        put(c.separation, separation);
        put(c.drift, get(c.drift) + step.h * (size(speed.along) + size(moving.edgeX) + size(moving.edgeY)));
    }
    const Bits apart = separation > zero, active = get(c.active);
    const Eight before = get(c.normalImpulse), tangentBefore = get(c.tangentImpulse);
    Eight wanted = where(apart, separation * step.inverseH);  // speed that closes the gap
    if constexpr (push) {
        const Bits still = get(c.still);
        const Eight slop = get(c.slop), rate = choose(still, all(step.still.biasRate), all(step.moving.biasRate));
        const Eight fastest = -kPushLengthsPerSecond * kSlopsPerLength * slop;
        const Eight bias = choose(apart, wanted, most(rate * least(zero, separation + slop), fastest));
        const Eight massScale =
            choose(apart, one, choose(still, all(step.still.massScale), all(step.moving.massScale)));
        const Eight impulseScale =
            where(~apart, choose(still, all(step.still.impulseScale), all(step.moving.impulseScale)));
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
void solveAll(ContactBlock* blocks, std::size_t count, const Particles& particles, const ContactStep& step)
{
    for (std::size_t i = 0; i < count; ++i)
        if (blocks[i].any) solveOne<push>(blocks[i], particles, step);
}

void solve(ContactBlock* blocks, std::size_t count, const Particles& particles, const ContactStep& step, bool push)
{
    push ? solveAll<true>(blocks, count, particles, step) : solveAll<false>(blocks, count, particles, step);
}

void bounce(ContactBlock* blocks, std::size_t count, const Particles& particles, float restSpeed)
{
    const Eight zero{};
    for (std::size_t i = 0; i < count; ++i) {
        ContactBlock& c = blocks[i];
        if (!c.bounces) continue;
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
