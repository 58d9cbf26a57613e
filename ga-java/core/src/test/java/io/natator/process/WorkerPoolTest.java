package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.protocol.SimulationResult;
import java.util.concurrent.BrokenBarrierException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.CyclicBarrier;
import java.util.concurrent.TimeUnit;
import java.util.stream.LongStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(value = 30, unit = TimeUnit.MINUTES)
class WorkerPoolTest {

    @Test
    void resultsComeInTheOrderOfTheRequests() throws InterruptedException {
        CountDownLatch others = new CountDownLatch(10);
        FakePool.Simulation slowFirst = request -> {
            if (request.id() == 0) {
                others.await();
            }
            others.countDown();
            return SimulationResult.failed(request.id(), "");
        };
        try (Evaluator pool = new FakePool(slowFirst, 4)) {
            assertThat(pool.evaluate(FakeSimulator.requests(50, "any"))).extracting(SimulationResult::id)
                    .containsExactlyElementsOf(LongStream.range(0, 50).boxed().toList());
        }
    }

    /** Three evaluations wait for each other, which only ends if all three run at once. */
    @Test
    void workersWorkAtTheSameTime() throws InterruptedException {
        CyclicBarrier barrier = new CyclicBarrier(3);
        FakePool.Simulation meeting = request -> {
            try {
                barrier.await();
            } catch (BrokenBarrierException e) {
                throw new IllegalStateException(e);
            }
            return SimulationResult.failed(request.id(), "");
        };
        try (Evaluator pool = new FakePool(meeting, 3)) {
            assertThat(pool.evaluate(FakeSimulator.requests(9, "any"))).hasSize(9);
        }
    }

    /** As memory, or a class that cannot be read for want of open files. */
    @Test
    void whatJavaLacksIsToldAsItIs() {
        FakePool.Simulation lacking = request -> {
            throw new NoClassDefFoundError("io/natator/Part");
        };
        try (Evaluator pool = new FakePool(lacking, 2)) {
            assertThatThrownBy(() -> pool.evaluate(FakeSimulator.requests(5, "any")))
                    .isInstanceOf(NoClassDefFoundError.class);
        }
    }
}
