/** How much a swimmer's motion is like that of real fish (thesis 2.8), and how its body moves as a whole. */
package io.natator.kinematics;
