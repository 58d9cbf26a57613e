package io.natator.export;

import io.natator.stream.StreamScene;
import java.nio.ByteBuffer;
import java.util.Arrays;
import java.util.List;
import java.util.function.Predicate;
import java.util.stream.IntStream;

/** Some of a scene's particles, and what stays the same about them. */
final class ParticleSet {

    /** The cluster of a particle that belongs to none. */
    static final int NO_CLUSTER = -1;
    /** The creature of a particle that belongs to none. */
    static final int NO_CREATURE = -1;

    private final int[] index;
    private final int[] place;
    private final ParticleKind[] kind;
    private final int[] cluster;
    private final int[] creature;
    private final float[] mass;

    private ParticleSet(StreamScene scene, int[] particles) {
        ParticleKind[] kinds = kinds(scene);
        int[] clusters = firstClusters(scene);
        int[] creatures = creatures(scene);
        index = particles;
        place = new int[scene.particles()];
        Arrays.fill(place, -1);
        kind = new ParticleKind[index.length];
        cluster = new int[index.length];
        creature = new int[index.length];
        mass = new float[index.length];
        for (int i = 0; i < index.length; i++) {
            place[index[i]] = i;
            kind[i] = kinds[index[i]];
            cluster[i] = clusters[index[i]];
            creature[i] = creatures[index[i]];
            Double value = scene.mass().get(index[i]);
            mass[i] = value == null ? Float.POSITIVE_INFINITY : value.floatValue();
        }
    }

    /** All particles, or all but the water. */
    static ParticleSet of(StreamScene scene, boolean water) {
        return those(scene, kind -> water || kind != ParticleKind.WATER);
    }

    /** The water alone. */
    static ParticleSet water(StreamScene scene) {
        return those(scene, kind -> kind == ParticleKind.WATER);
    }

    /** Those of the swimmer and of companions. */
    static ParticleSet creaturesOf(StreamScene scene) {
        return ofCreatures(scene, true);
    }

    /** Those of one creature: 0 the swimmer, from 1 on companions. */
    static ParticleSet ofCreature(StreamScene scene, int creature) {
        int[] creatures = creatures(scene);
        return new ParticleSet(scene,
                IntStream.range(0, scene.particles()).filter(particle -> creatures[particle] == creature).toArray());
    }

    /** Solids of no creature. */
    static ParticleSet obstacles(StreamScene scene) {
        return ofCreatures(scene, false);
    }

    private static ParticleSet ofCreatures(StreamScene scene, boolean any) {
        int[] creatures = creatures(scene);
        return new ParticleSet(scene, IntStream.range(0, scene.particles()).filter(particle ->
                !scene.isFluid(particle) && any == (creatures[particle] != NO_CREATURE)).toArray());
    }

    /** These particles in this order; one may occur more than once. */
    static ParticleSet listed(StreamScene scene, int[] particles) {
        return new ParticleSet(scene, particles.clone());
    }

    private static ParticleSet those(StreamScene scene, Predicate<ParticleKind> wanted) {
        ParticleKind[] kinds = kinds(scene);
        return new ParticleSet(scene,
                IntStream.range(0, scene.particles()).filter(particle -> wanted.test(kinds[particle])).toArray());
    }

    private static ParticleKind[] kinds(StreamScene scene) {
        ParticleKind[] kinds = new ParticleKind[scene.particles()];
        Arrays.fill(kinds, ParticleKind.OTHER);
        Arrays.fill(kinds, scene.firstFluid(), scene.firstFluid() + scene.fluidCount(), ParticleKind.WATER);
        scene.body().forEach(particle -> kinds[particle] = ParticleKind.BODY);
        return kinds;
    }

    /** Of the clusters that a joint's particle belongs to, the one nearer the head. */
    private static int[] firstClusters(StreamScene scene) {
        int[] clusters = new int[scene.particles()];
        Arrays.fill(clusters, NO_CLUSTER);
        for (int i = scene.clusters().size() - 1; i >= 0; i--) {
            List<Integer> members = scene.clusters().get(i);
            for (int particle : members) {
                clusters[particle] = i;
            }
        }
        return clusters;
    }

    /** 0 of the swimmer, 1 of the first companion, and so on. */
    static int[] creatures(StreamScene scene) {
        int[] creatures = new int[scene.particles()];
        Arrays.fill(creatures, NO_CREATURE);
        for (int i = 0; i < scene.companions().size(); i++) {
            for (int particle : scene.companions().get(i).body()) {
                creatures[particle] = i + 1;
            }
        }
        scene.body().forEach(particle -> creatures[particle] = 0);
        return creatures;
    }

    int size() {
        return index.length;
    }

    /** Index in the scene of the i-th particle. */
    int index(int i) {
        return index[i];
    }

    /** Which of these the scene's particle is; −1 if it is none of them. */
    int placeOf(int particle) {
        return place[particle];
    }

    ParticleKind kind(int i) {
        return kind[i];
    }

    /** The first cluster of the i-th particle, from the head on, or {@link #NO_CLUSTER}. */
    int cluster(int i) {
        return cluster[i];
    }

    /** The creature of the i-th particle: 0 the swimmer, from 1 on companions, or {@link #NO_CREATURE}. */
    int creature(int i) {
        return creature[i];
    }

    /** Mass of the i-th particle; infinite if it is held in place. */
    float mass(int i) {
        return mass[i];
    }

    /** Writes the values of these particles, out of those of all. */
    void put(float[] values, int components, ByteBuffer out) {
        for (int particle : index) {
            for (int i = particle * components; i < (particle + 1) * components; i++) {
                out.putFloat(values[i]);
            }
        }
    }

    /** The values of these particles, out of those of all. */
    float[] values(float[] all, int components) {
        float[] values = new float[index.length * components];
        for (int i = 0; i < index.length; i++) {
            System.arraycopy(all, index[i] * components, values, i * components, components);
        }
        return values;
    }

    /** The values of these particles in a buffer of their own. */
    ByteBuffer floats(float[] values, int components) {
        ByteBuffer out = LittleEndian.buffer((long) size() * components * Float.BYTES);
        put(values, components, out);
        return out.flip();
    }

    /** Masses. */
    ByteBuffer masses() {
        return LittleEndian.floats(mass);
    }

    /** Ordinals of the kinds, a byte each. */
    ByteBuffer kinds() {
        ByteBuffer out = LittleEndian.buffer(size());
        Arrays.stream(kind).forEach(one -> out.put((byte) one.ordinal()));
        return out.flip();
    }

    /** First clusters, 32-bit. */
    ByteBuffer clusters() {
        return LittleEndian.ints(cluster);
    }

    /** Creatures, 32-bit. */
    ByteBuffer creatures() {
        return LittleEndian.ints(creature);
    }

    /** Indices in the scene, 32-bit. */
    ByteBuffer indices() {
        return LittleEndian.ints(index);
    }
}
