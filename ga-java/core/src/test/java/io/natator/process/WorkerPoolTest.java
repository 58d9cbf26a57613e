package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.BrokenBarrierException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.CyclicBarrier;
import java.util.concurrent.TimeUnit;
import java.util.stream.LongStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(value = 30, unit = TimeUnit.MINUTES)
class WorkerPoolTest {

    private static List<SimulationRequest> requests(int count) {
        return LongStream.range(0, count).mapToObj(id -> FakeSimulator.request(id, "any")).toList();
    }

    @Test
    void resultsComeInTheOrderOfTheRequests() throws InterruptedException {
        CountDownLatch others = new CountDownLatch(10);
        Simulator slowFirst = simulator(request -> {
            if (request.id() == 0) {
                others.await();
            }
            others.countDown();
            return SimulationResult.failed(request.id(), "");
        });
        List<Long> ids = new ArrayList<>();
        try (WorkerPool pool = new WorkerPool(slowFirst, 4)) {
            pool.evaluateInOrder(requests(50), result -> ids.add(result.id()));
        }

        assertThat(ids).containsExactlyElementsOf(LongStream.range(0, 50).boxed().toList());
    }

    /** Three evaluations wait for each other, which only ends if all three run at once. */
    @Test
    void workersWorkAtTheSameTime() throws InterruptedException {
        CyclicBarrier barrier = new CyclicBarrier(3);
        Simulator meeting = simulator(request -> {
            try {
                barrier.await();
            } catch (BrokenBarrierException e) {
                throw new IllegalStateException(e);
            }
            return SimulationResult.failed(request.id(), "");
        });
        List<SimulationResult> results = new ArrayList<>();
        try (WorkerPool pool = new WorkerPool(meeting, 3)) {
            pool.evaluateInOrder(requests(9), results::add);
        }

        assertThat(results).hasSize(9);
    }

    @Test
    void aRejectedRequestEndsTheBatch() {
        Simulator rejecting = simulator(request -> {
            throw new RequestRejectedException("unknown scene", true);
        });
        try (WorkerPool pool = new WorkerPool(rejecting, 2)) {
            assertThatThrownBy(() -> pool.evaluateInOrder(requests(5), result -> { }))
                    .isInstanceOf(RequestRejectedException.class).hasMessage("unknown scene");
        }
    }

    /** As memory, or a class that cannot be read for want of open files. */
    @Test
    void whatJavaLacksIsToldAsItIs() {
        Simulator lacking = simulator(request -> {
            throw new NoClassDefFoundError("io/natator/Part");
        });
        try (WorkerPool pool = new WorkerPool(lacking, 2)) {
            assertThatThrownBy(() -> pool.evaluateInOrder(requests(5), result -> { })).isInstanceOf(NoClassDefFoundError.class);
        }
    }

    private interface Answer {
        SimulationResult to(SimulationRequest request) throws InterruptedException;
    }

    private static Simulator simulator(Answer answer) {
        return new Simulator() {
            @Override
            public SimulationResult evaluate(SimulationRequest request) throws InterruptedException {
                return answer.to(request);
            }

            @Override
            public void close() {
                // Nothing is held.
            }
        };
    }
}
