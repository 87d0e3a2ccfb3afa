/* Calls the functions of every robot a few times: what is measured. */
#include "cart_pole.h"
#include "iiwa14.h"
#include "leg.h"
#include "puma560.h"

/* Of a robot with N joints. */
#define MEASURED(robot, N)                                                    \
    static void robot##_all(float scale)                                      \
    {                                                                         \
        float q[N];                                                           \
        float v[N];                                                           \
        float a[N];                                                           \
        float x[N];                                                           \
        float A[N][N];                                                        \
        float B[N][N];                                                        \
        float C[N][N];                                                        \
        for (int k = 0; k < N; ++k) {                                         \
            q[k] = 0.3f * scale;                                              \
            v[k] = 0.7f * scale;                                              \
            a[k] = -1.1f * scale;                                             \
        }                                                                     \
        robot##_mass_matrix(q, A);                                            \
        robot##_coriolis_matrix(q, v, A);                                     \
        robot##_gravity_forces(q, x);                                         \
        robot##_bias_forces(q, v, x);                                         \
        robot##_equations_of_motion(q, v, A, B, x);                           \
        robot##_inverse_dynamics(q, v, a, x);                                 \
        robot##_forward_dynamics(q, v, a, x);                                 \
        robot##_inverse_derivatives(q, v, a, A, B, C);                        \
        robot##_forward_derivatives(q, v, a, A, B, C);                        \
    }

MEASURED(cart_pole, CART_POLE_NV)
MEASURED(leg, LEG_NV)
MEASURED(puma560, PUMA560_NV)
MEASURED(iiwa14, IIWA14_NV)

int main(void);

int main(void)
{
    static const float scales[] = {0.0f, 1.0f, -7.3f};
    for (int k = 0; k < 3; ++k) {
        cart_pole_all(scales[k]);
        leg_all(scales[k]);
        puma560_all(scales[k]);
        iiwa14_all(scales[k]);
    }
    return 0;
}
