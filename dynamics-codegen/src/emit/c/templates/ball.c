/* How orientations move. Quaternions are i, j, k, w; twists are of the body in the body, linear first. Quotients that
 * would be 0/0 at the angle zero are taken at the root of its square and 1e-16.
 */
typedef struct {
    REAL axis[3]; /* of unit length, but zero where the angle is */
    REAL angle;
    REAL half_sine;
    REAL half_cosine;
} PREFIX_turn;

static REAL PREFIX_dot(const REAL a[3], const REAL b[3])
{
    return a[2] * b[2] + (a[1] * b[1] + a[0] * b[0]);
}

static PREFIX_turn PREFIX_turn_by(const REAL delta[3])
{
    PREFIX_turn turn;
    turn.angle = UPPER_SQRT(PREFIX_dot(delta, delta) + (REAL)1e-16);
    UPPER_SIN_COS(turn.angle * (REAL)0.5, &turn.half_sine, &turn.half_cosine);
    const REAL factor = (REAL)1.0 / turn.angle;
    for (int k = 0; k < 3; ++k) {
        turn.axis[k] = delta[k] * factor;
    }
    return turn;
}

static void PREFIX_product(const REAL p[4], const REAL q[4], REAL r[4])
{
    r[0] = p[3] * q[0] + p[0] * q[3] + p[1] * q[2] - p[2] * q[1];
    r[1] = p[3] * q[1] - p[0] * q[2] + p[1] * q[3] + p[2] * q[0];
    r[2] = p[3] * q[2] + p[0] * q[1] - p[1] * q[0] + p[2] * q[3];
    r[3] = p[3] * q[3] - p[0] * q[0] - p[1] * q[1] - p[2] * q[2];
}

/* q exp(delta), of unit length: delta in rad, in the axes of the body. One Newton step towards length 1 follows. */
static void PREFIX_integrate_ball(const REAL q[4], const REAL delta[3], REAL moved[4])
{
    const PREFIX_turn turn = PREFIX_turn_by(delta);
    REAL by[4];
    REAL r[4];
    for (int k = 0; k < 3; ++k) {
        by[k] = turn.axis[k] * turn.half_sine;
    }
    by[3] = turn.half_cosine;
    PREFIX_product(q, by, r);
    const REAL square = r[3] * r[3] + (r[2] * r[2] + (r[1] * r[1] + r[0] * r[0]));
    const REAL scale = (REAL)-0.5 * square + (REAL)1.5;
    for (int k = 0; k < 4; ++k) {
        moved[k] = r[k] * scale;
    }
}
