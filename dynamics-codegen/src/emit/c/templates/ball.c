/* How orientations move. Quaternions are i, j, k, w; twists are of the body in the body, linear first. There is no
 * branch: quotients that would be 0/0 at the angle zero are taken at the root of its square and 1e-16, and what a
 * logarithm divides by is not small.
 */
typedef struct {
    REAL axis[3]; /* of unit length, but zero where the angle is */
    REAL angle;
    REAL half_sine;
    REAL half_cosine;
} PREFIX_turn;

static REAL PREFIX_dot(const REAL a[3], const REAL b[3])
{
    return (a[2] * b[2]) + ((a[1] * b[1]) + (a[0] * b[0]));
}

static void PREFIX_turn_by(const REAL delta[3], PREFIX_turn *turn)
{
    turn->angle = UPPER_SQRT(PREFIX_dot(delta, delta) + (REAL)1e-16);
    UPPER_SIN_COS(turn->angle * (REAL)0.5, &turn->half_sine, &turn->half_cosine);
    const REAL factor = (REAL)1.0 / turn->angle;
    for (int k = 0; k < 3; ++k) {
        turn->axis[k] = delta[k] * factor;
    }
}

static void PREFIX_product(const REAL p[4], const REAL q[4], REAL r[4])
{
    r[0] = (p[3] * q[0]) + (p[0] * q[3]) + (p[1] * q[2]) - (p[2] * q[1]);
    r[1] = (p[3] * q[1]) - (p[0] * q[2]) + (p[1] * q[3]) + (p[2] * q[0]);
    r[2] = (p[3] * q[2]) + (p[0] * q[1]) - (p[1] * q[0]) + (p[2] * q[3]);
    r[3] = (p[3] * q[3]) - (p[0] * q[0]) - (p[1] * q[1]) - (p[2] * q[2]);
}

static void PREFIX_conjugate(const REAL q[4], REAL r[4])
{
    r[0] = -q[0];
    r[1] = -q[1];
    r[2] = -q[2];
    r[3] = q[3];
}

/* q exp(delta), of unit length: delta in rad, in the axes of the body. One Newton step towards length 1 follows. */
static void PREFIX_integrate_ball(const REAL q[4], const REAL delta[3], REAL moved[4])
{
    PREFIX_turn turn;
    REAL by[4];
    REAL r[4];
    PREFIX_turn_by(delta, &turn);
    for (int k = 0; k < 3; ++k) {
        by[k] = turn.axis[k] * turn.half_sine;
    }
    by[3] = turn.half_cosine;
    PREFIX_product(q, by, r);
    const REAL square = (r[3] * r[3]) + ((r[2] * r[2]) + ((r[1] * r[1]) + (r[0] * r[0])));
    const REAL scale = ((REAL)-0.5 * square) + (REAL)1.5;
    for (int k = 0; k < 4; ++k) {
        moved[k] = r[k] * scale;
    }
}

/* atan(sqrt(z)) / sqrt(z) for z up to (7/16)^2: the polynomial of fdlibm (Sun Microsystems 1993). */
static REAL PREFIX_arctangent(REAL z)
{
    REAL sum = (REAL)-1.6285820115365782e-2;
    sum = (sum * z) + (REAL)3.6531572744216916e-2;
    sum = (sum * z) + (REAL)-4.976877994615932e-2;
    sum = (sum * z) + (REAL)5.8335701337905735e-2;
    sum = (sum * z) + (REAL)-6.661073137387531e-2;
    sum = (sum * z) + (REAL)7.69187620504483e-2;
    sum = (sum * z) + (REAL)-9.090887133436507e-2;
    sum = (sum * z) + (REAL)1.1111110405462356e-1;
    sum = (sum * z) + (REAL)-1.4285714272503466e-1;
    sum = (sum * z) + (REAL)1.9999999999876483e-1;
    sum = (sum * z) + (REAL)-3.333333333333293e-1;
    return (sum * z) + (REAL)1.0;
}

/* The rotation vector of a quaternion, of length up to pi: eight times the arctangent of the tangent of angle/8, which
 * comes from half angles. q and -q are one orientation.
 */
static void PREFIX_logarithm(const REAL q[4], REAL turn[3])
{
    const REAL off_zero = q[3] + (REAL)1.618e-18; /* so that zero has a sign */
    const REAL rough = off_zero / UPPER_SQRT(off_zero * off_zero);
    const REAL sign = rough * (((REAL)-0.5 * (rough * rough)) + (REAL)1.5);
    const REAL w = sign * q[3];
    REAL u[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = q[k] * sign;
    }
    const REAL square = PREFIX_dot(u, u);
    const REAL quarter = (REAL)1.0 / (UPPER_SQRT((w * w) + square) + w);
    const REAL eighth = (REAL)1.0 / (UPPER_SQRT((square * quarter * quarter) + (REAL)1.0) + (REAL)1.0);
    const REAL factor = quarter * eighth;
    const REAL scale = (REAL)8.0 * factor * PREFIX_arctangent(square * factor * factor);
    for (int k = 0; k < 3; ++k) {
        turn[k] = u[k] * scale;
    }
}

/* The shortest delta with q1 = q0 exp(delta), in rad. */
static void PREFIX_difference_ball(const REAL q0[4], const REAL q1[4], REAL delta[3])
{
    REAL back[4];
    REAL turned[4];
    PREFIX_conjugate(q0, back);
    PREFIX_product(back, q1, turned);
    PREFIX_logarithm(turned, delta);
}
