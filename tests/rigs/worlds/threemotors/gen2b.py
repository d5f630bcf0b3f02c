from gen2 import *
run2('m2/brake_small.csv',[12,-12],2.1,brake=.02)
run2('m2/brake_big.csv',[12,-12],2.1,brake=.045)
