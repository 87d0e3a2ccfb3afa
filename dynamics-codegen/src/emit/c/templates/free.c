static void PREFIX_cross(const REAL a[3], const REAL b[3], REAL c[3])
{
    c[0] = (a[1] * b[2]) - (a[2] * b[1]);
    c[1] = (a[2] * b[0]) - (a[0] * b[2]);
    c[2] = (a[0] * b[1]) - (a[1] * b[0]);
}

/* From the axes of the body to those that q is given in. */
static void PREFIX_rotated(const REAL q[4], const REAL x[3], REAL y[3])
{
    REAL turned[3];
    REAL twice[3];
    PREFIX_cross(q, x, turned);
    for (int k = 0; k < 3; ++k) {
        turned[k] = turned[k] + turned[k];
    }
    PREFIX_cross(q, turned, twice);
    for (int k = 0; k < 3; ++k) {
        y[k] = (x[k] + (turned[k] * q[3])) + twice[k];
    }
}

/* The same of a body with a position, by a screw in m and rad. */
static void PREFIX_integrate_free(const REAL q[7], const REAL delta[6], REAL moved[7])
{
    PREFIX_turn turn;
    REAL across[3];
    REAL by[3];
    REAL way[3];
    PREFIX_turn_by(&delta[3], &turn);
    const REAL two_s = turn.half_sine + turn.half_sine;
    const REAL sinc = two_s * turn.half_cosine / turn.angle;
    const REAL along = ((REAL)1.0 - sinc) * PREFIX_dot(turn.axis, delta);
    const REAL over = two_s * turn.half_sine / turn.angle;
    PREFIX_cross(turn.axis, delta, across);
    for (int k = 0; k < 3; ++k) {
        by[k] = ((delta[k] * sinc) + (across[k] * over)) + (turn.axis[k] * along);
    }
    PREFIX_rotated(&q[3], by, way);
    for (int k = 0; k < 3; ++k) {
        moved[k] = q[k] + way[k];
    }
    PREFIX_integrate_ball(&q[3], &delta[3], &moved[3]);
}

/* The shortest screw from q0 to q1, in m and rad. */
static void PREFIX_difference_free(const REAL q0[7], const REAL q1[7], REAL delta[6])
{
    PREFIX_turn turn;
    REAL back[4];
    REAL way[3];
    REAL moved[3];
    REAL across[3];
    REAL inwards[3];
    REAL twice[3];
    for (int k = 0; k < 3; ++k) {
        way[k] = q1[k] - q0[k];
    }
    PREFIX_conjugate(&q0[3], back);
    PREFIX_rotated(back, way, moved);
    PREFIX_difference_ball(&q0[3], &q1[3], &delta[3]);
    PREFIX_turn_by(&delta[3], &turn);
    const REAL shrink = (REAL)1.0 - ((REAL)0.5 * turn.angle * turn.half_cosine / turn.half_sine);
    PREFIX_cross(&delta[3], moved, across);
    PREFIX_cross(turn.axis, moved, inwards);
    PREFIX_cross(turn.axis, inwards, twice);
    for (int k = 0; k < 3; ++k) {
        delta[k] = (moved[k] + (across[k] * (REAL)-0.5)) + (twice[k] * shrink);
    }
}
