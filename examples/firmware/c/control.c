/* A leg on a bench goes to a pose under computed torque, a thousand times a second, in an interrupt. */
#include <stdint.h>
#include "board.h"
#include "leg.h"

#define STEPS 200u
#define STEP 1e-3f
#define SYST_CSR (*(volatile uint32_t *)0xe000e010u)
#define SYST_RVR (*(volatile uint32_t *)0xe000e014u)

int main(void);
void SysTick_Handler(void);

static const float pose[LEG_NQ] = {0.1f, -0.5f, 1.2f};
static const float swing[LEG_NQ] = {0.2f, 0.3f, -0.4f};

/* What the interrupt keeps. The functions of the leg keep nothing. */
static float q[LEG_NQ];
static float v[LEG_NV];
static float torques[STEPS][LEG_NV];
static volatile uint32_t steps;

/* tau = ID(q, v, 400 e + 40 e'): each joint's error falls as that of a critically damped spring of 20 rad/s. */
static void control(float tau[LEG_NV])
{
    float e[LEG_NV];
    float a[LEG_NV];
    leg_difference(q, pose, e);
    for (int k = 0; k < LEG_NV; ++k) {
        a[k] = (400.0f * e[k]) - (40.0f * v[k]);
    }
    leg_inverse_dynamics(q, v, a, tau);
}

/* In place of motors and encoders: the leg moves on under these torques, by the semi-implicit method of Euler. */
static void move(const float tau[LEG_NV])
{
    float a[LEG_NV];
    float delta[LEG_NV];
    leg_forward_dynamics(q, v, tau, a);
    for (int k = 0; k < LEG_NV; ++k) {
        v[k] += STEP * a[k];
        delta[k] = STEP * v[k];
    }
    leg_integrate(q, delta, q);
}

void SysTick_Handler(void)
{
    const uint32_t step = steps;
    if (step < STEPS) {
        control(torques[step]);
        move(torques[step]);
        steps = step + 1u;
    }
}

/* The bits of x in hexadecimal digits, and a space. */
static void put_bits(float x)
{
    union {
        float real;
        uint32_t bits;
    } value;
    char digits[10];
    value.real = x;
    for (int k = 0; k < 8; ++k) {
        digits[7 - k] = "0123456789abcdef"[value.bits & 15u];
        value.bits >>= 4;
    }
    digits[8] = ' ';
    digits[9] = '\0';
    put(digits);
}

int main(void)
{
    for (int k = 0; k < LEG_NQ; ++k) {
        q[k] = pose[k] + swing[k];
    }
    SYST_RVR = 25000u - 1u; /* of 25 MHz */
    SYST_CSR = 7u;
    while (steps < STEPS) {
    }
    for (uint32_t step = 0u; step < STEPS; ++step) {
        for (int k = 0; k < LEG_NV; ++k) {
            put_bits(torques[step][k]);
        }
        put("\n");
    }
    return 0;
}
